#pragma once

#include <cstdint>

namespace splotchcl {

// A hash whose every bit depends on every bit of the key: the finalizer of SplitMix64.
inline std::uint64_t hash_of(std::uint64_t key) {
  key += 0x9e3779b97f4a7c15U;
  key = (key ^ (key >> 30)) * 0xbf58476d1ce4e5b9U;
  key = (key ^ (key >> 27)) * 0x94d049bb133111ebU;
  return key ^ (key >> 31);
}

}  // namespace splotchcl
