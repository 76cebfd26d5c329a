#pragma once

#include <cstdint>
#include <vector>

namespace splotchcl {

// Where the splats of an ordered frame do not fit into memory together, they are drawn slice by
// slice of their sort keys, nearest first (docs/large.md). Keys have 48 bits.
constexpr int bits_of_key = 48;
constexpr std::uint64_t end_of_keys = std::uint64_t{1} << bits_of_key;
// The bits of a key that number its bin.
constexpr int bits_of_key_bin = 16;
// Of the bins that hold all keys.
constexpr int shift_of_all_keys = bits_of_key - bits_of_key_bin;

// Splats whose keys lie in [first, end).
struct KeyWindow {
  std::uint64_t first = 0, end = end_of_keys;
  std::uint64_t splats = 0;
};

// How many splats each of 2^16 bins of keys has: key >> shift, of the keys in a window.
struct CountedKeys {
  KeyWindow window;
  int shift = shift_of_all_keys;
  std::vector<std::uint64_t> bins;
};

}  // namespace splotchcl
