#include "tree/particle_tree.h"

#include <bitset>
#include <cstring>

namespace splotchcl {
namespace {

// Of all bytes [first, end) together.
std::uint64_t bits_in(const std::uint8_t* bytes, std::uint64_t first, std::uint64_t end) {
  std::uint64_t count = 0;
  for (; first + sizeof(std::uint64_t) <= end; first += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes + first, sizeof word);
    count += std::bitset<64>(word).count();
  }
  for (; first < end; ++first)
    count += std::bitset<8>(bytes[first]).count();
  return count;
}

}  // namespace

std::uint64_t TreeLevel::first_child(std::uint64_t node) const {
  return first_children[node / group] + bits_in(children, node / group * group, node);
}

std::uint64_t TreeLevel::first_loose_particle(std::uint64_t node) const {
  std::uint64_t first = first_loose[node / group];
  for (std::uint64_t before = node / group * group; before < node; ++before)
    first += loose[before];
  return first;
}

std::uint64_t TreeOfType::node_count() const {
  std::uint64_t count = 0;
  for (const TreeLevel& level : levels)
    count += level.count;
  return count;
}

}  // namespace splotchcl
