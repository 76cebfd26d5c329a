#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace splotchcl {

// Which particles of two snapshots are the same.
struct IdMatch {
  static constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

  // For each particle of the first its place in the second, or nobody: it vanishes.
  std::vector<std::uint32_t> place_in_second;
  std::vector<std::uint32_t> appearing;  // places in the second, in its order
  std::size_t in_common = 0;
  // Particles, of both, that share their id with others of their snapshot: which of them is
  // which cannot be told, so they vanish and appear.
  std::size_t ambiguous = 0;

  std::size_t particles() const { return place_in_second.size() + appearing.size(); }
};

// On all cores; the same for any number of them. Up to 2^32 - 2 particles each, else throws
// DataError.
IdMatch match_ids(const std::vector<std::uint64_t>& first,
                  const std::vector<std::uint64_t>& second);

}  // namespace splotchcl
