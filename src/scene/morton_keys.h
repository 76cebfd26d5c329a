#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace splotchcl {

constexpr int key_levels = 21;
constexpr std::size_t octants = 8;

struct KeyedParticle {
  std::uint64_t key = 0;
  std::uint32_t place = 0;  // in the snapshot, or among those held
};

// 63 bits of a place in the unit cube: of three axes from the highest on, x the lowest of each
// triple.
std::uint64_t morton_key(const std::array<double, 3>& place);

inline std::size_t octant_at(std::uint64_t key, int level) {
  return static_cast<std::size_t>(key >> (3 * (key_levels - 1 - level))) & (octants - 1);
}
// The cell of a level that a key lies in, of 8^level.
inline std::size_t cell_at(std::uint64_t key, int level) {
  return static_cast<std::size_t>(key >> (3 * (key_levels - level)));
}

// Stable.
void sort_by_key(std::vector<KeyedParticle>& particles);

}  // namespace splotchcl
