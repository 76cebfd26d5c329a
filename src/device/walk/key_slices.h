#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "device/frame/chunks.h"

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

// A stretch of the order that is sorted and composited at one time, by one rank.
struct KeySlice {
  SplatPlace begin, end;
  std::uint64_t first = 0;   // splat of the order
  std::uint64_t splats = 0;  // in it
};

// Where a splat of this place belongs: the slices follow each other. slices.size(): to none.
std::size_t slice_of(const SplatPlace& place, const KeySlice* slices, std::size_t count);

// The keys that the slices may have: those of the first and of the last may be other slices', too.
KeyWindow window_of(const KeySlice* slices, std::size_t count);

// The keys of the slice's splats that come from this chunk of particles.
KeyWindow window_of_chunk(const KeySlice& slice, std::uint64_t chunk);

// Counts the keys of a window in bins of 2^shift of them.
using CountKeys = std::function<CountedKeys(const KeyWindow& window, int shift)>;

// How many splats of one key each chunk of particles has.
using CountChunks = std::function<std::vector<std::uint64_t>(const KeyWindow& window)>;

// All splats in slices of about as many each: one for each rank or, where more than `capacity`
// would be in one, several rounds of that. More than that are in one only where they are of one key
// and one chunk. `count` is called for bins that are too large to be shared out, `count_chunks`
// where one key has too many.
std::vector<KeySlice> cut_in_slices(const CountedKeys& counted, std::size_t ranks,
                                    std::uint64_t capacity, const CountKeys& count,
                                    const CountChunks& count_chunks);

// What of the order a slice composites: the chunks that end in it. What a chunk that ends behind
// the slice has of it goes to the next one, which carries it in front of its own.
struct SlicePart {
  std::uint64_t first = 0;    // splat of the order: the first that is carried, or its own
  std::uint32_t carried = 0;  // splats of slices before
  std::uint32_t own = 0;
  std::size_t first_chunk = 0, end_chunk = 0;  // of the order
  std::uint32_t passed_on = 0;                 // the last ones of both

  std::uint32_t splats() const { return carried + own; }
  std::uint32_t composited() const { return splats() - passed_on; }
};

SlicePart part_of(const KeySlice& slice, const std::vector<SplatChunk>& chunks);

// Clouds [first, end) of those around the camera, in their order.
struct CloudRange {
  std::size_t first = 0, end = 0;
  std::uint32_t count() const { return static_cast<std::uint32_t>(end - first); }
};

// For each slice of the order the clouds around the camera that lie in it, of which these are the
// keys: each behind the splats of its key. None lies outside.
std::vector<CloudRange> clouds_of_slices(const std::vector<std::uint64_t>& keys,
                                         const std::vector<KeySlice>& slices);

// The slice, in whose order clouds are counted like splats.
KeySlice with_clouds(KeySlice slice, const CloudRange& clouds);

}  // namespace splotchcl
