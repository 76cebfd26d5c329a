#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "device/opencl/device_traits.h"
#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

// The splats of a large ordered frame are put in parts by the upper 32 bits of their sort keys as
// they are projected, so that each part is sorted, and fetched in order, in a processor's cache.
// Which splat comes before which never depends on the parts.
namespace splotchcl {

// Splats whose upper bits lie in [first, end). The first part has those of smaller keys, too, and
// the last one those of larger ones.
struct KeyPart {
  std::uint64_t first = 0, end = 0;
};

// As many as a byte tells apart.
constexpr std::size_t most_key_parts = 256;

struct KeyParts {
  // Bin (upper - first_key) >> shift, or the first or last bin.
  std::uint32_t first_key = 0, shift = 0;
  std::vector<std::uint8_t> part_of_bin;  // KEY_PART_BINS of them, ascending
  std::vector<KeyPart> parts;             // at most most_key_parts, one after the other
};

// Parts of about as many of the expected splats each as the device's traits say, or of more where
// that would be too many parts, from an ascending sample of their keys of 48 bits. Nothing where a
// few parts would do, or where one of them would have a large part of all splats.
std::optional<KeyParts> choose_key_parts(const std::vector<std::uint64_t>& sampled_keys,
                                         double expected_splats, const DeviceTraits& traits);

// Those of a frame that is drawn in one piece. Nothing of groups, whose local memory holds no part,
// nor of splats that are more than their words (extended numbers) or lie several times in the
// picture.
std::optional<KeyParts> choose_key_parts(const Frame& frame, const FramePlan& plan,
                                         const DeviceTraits& traits);

// How many blocks of particles are projected at a time before their splats are put in parts, and
// how many parts are sorted at a time: enough for all threads.
std::uint32_t blocks_apart(const DeviceTraits& traits);
std::uint32_t parts_at_a_time(const DeviceTraits& traits);

}  // namespace splotchcl
