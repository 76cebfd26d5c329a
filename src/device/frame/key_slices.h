#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "device/frame/key_windows.h"

namespace splotchcl {

// A place in the order of all splats: by keys, and where these are equal by the chunks of particles
// that they come from, which are numbered through all ranks.
struct SplatPlace {
  std::uint64_t key = 0;
  std::uint64_t chunk = 0;

  bool operator<(const SplatPlace& other) const {
    return key != other.key ? key < other.key : chunk < other.chunk;
  }
};

// A stretch of the order that one rank sorts and composites at a time.
struct KeySlice {
  SplatPlace begin, end;
  std::uint64_t first = 0;   // splat of the order
  std::uint64_t splats = 0;  // in it
};

// Where a splat of this place belongs: the slices follow each other. slices.size(): to none.
std::size_t slice_of(const SplatPlace& place, const KeySlice* slices, std::size_t count);

// The keys that the slices may have: those of the first and of the last may be other slices', too.
KeyWindow window_of(const KeySlice* slices, std::size_t count);

// How many splats of one key each chunk has.
using CountChunks = std::function<std::vector<std::uint64_t>(const KeyWindow& window)>;

// All splats in slices of about as many each: one for each rank or, where more than `capacity`
// would be in one, several rounds of that. More than that are in one only where they are of one key
// and one chunk. `count` is called for bins that are too large to be shared out, `count_chunks`
// where one key has too many.
std::vector<KeySlice> cut_in_slices(const CountedKeys& counted, std::size_t ranks,
                                    std::uint64_t capacity, const CountKeys& count,
                                    const CountChunks& count_chunks);

}  // namespace splotchcl
