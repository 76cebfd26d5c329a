// The rules of scene/depth_key.h, written out here once more on purpose: the kernels' copy is
// tested against this one.
#include "reference/depth_key.h"

#include <algorithm>
#include <cmath>

namespace splotchcl::reference {
namespace {

constexpr std::uint64_t zero_depth = std::uint64_t{1} << 47;

using Integers = std::int64_t[3];

// The scalar product / 2^60; every factor is at most 2^60.
std::int64_t product(const Integers& a, const Integers& b) {
  constexpr std::int64_t part = std::int64_t{1} << 30;
  std::int64_t upper = 0, middle = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t a_high = a[axis] >> 30, a_low = a[axis] & (part - 1);
    const std::int64_t b_high = b[axis] >> 30, b_low = b[axis] & (part - 1);
    upper += a_high * b_high;
    middle += a_high * b_low + a_low * b_high;
  }
  return upper + (middle >> 30);
}

// magnitude * 2^exponent, in finest units or their squares.
struct Magnitude {
  std::uint64_t magnitude = 0;
  int exponent = 0;
};

int bit_count(std::uint64_t value) {
  int bits = 0;
  for (; value != 0; value >>= 1)
    ++bits;
  return bits;
}

std::uint64_t compressed(const Magnitude& value, std::uint64_t largest_exponent) {
  const int bits = bit_count(value.magnitude);
  if (bits == 0) return 0;
  const int beyond = std::max(0, bits + value.exponent - 41);
  const auto exponent = static_cast<std::uint64_t>(beyond);
  if (exponent > largest_exponent) return ((largest_exponent + 2) << 40) - 1;
  const int down = beyond - value.exponent;
  if (down < 0) return (exponent << 40) + (value.magnitude << -down);
  return (exponent << 40) + (down < 64 ? value.magnitude >> down : 0);
}

// From the camera, in 2^exponent finest units.
struct Place {
  Integers axes = {};
  int exponent = 0;
};

Place place_of(const float* position, const DepthKeyScale& scale) {
  int exponent = -127;
  for (int axis = 0; axis < 3; ++axis) {
    if (position[axis] != 0) exponent = std::max(exponent, std::ilogb(position[axis]));
  }
  const int coarser = std::max(0, exponent - scale.unit - 58);
  Place place;
  place.exponent = scale.unit + coarser - scale.finest_unit;
  for (int axis = 0; axis < 3; ++axis) {
    const double offset = std::ldexp(static_cast<double>(position[axis]), -scale.unit - coarser);
    place.axes[axis] = (scale.origin_from_camera[axis] >> std::min(coarser, 63)) +
                       static_cast<std::int64_t>(offset);
  }
  return place;
}

// Of the distance with these components.
Magnitude squared_length(const Integers& axes, int exponent) {
  std::uint64_t all = 0;
  for (const std::int64_t axis : axes)
    all |= static_cast<std::uint64_t>(std::abs(axis));
  if (all == 0) return {};
  const int doublings = 60 - bit_count(all);
  Integers doubled;
  for (int axis = 0; axis < 3; ++axis)
    doubled[axis] = std::abs(axes[axis]) << doublings;
  return {static_cast<std::uint64_t>(product(doubled, doubled)), 60 + 2 * (exponent - doublings)};
}

Depth depth_along_view(const Place& place, const DepthKeyScale& scale) {
  const std::int64_t z = product(place.axes, scale.forward);
  const std::uint64_t magnitude =
      compressed({static_cast<std::uint64_t>(std::abs(z)), place.exponent}, 126);
  Depth depth;
  depth.key = z < 0 ? zero_depth - magnitude : zero_depth + magnitude;
  depth.is_before_camera = !scale.is_perspective || z >= least_perspective_depth;
  return depth;
}

std::uint64_t near_key(float h, const DepthKeyScale& scale) {
  if (scale.near_factor == 0) return scale.near_key;
  int exponent = 0;
  const float fraction = std::frexp(h, &exponent);  // 24 bits
  const auto length = static_cast<std::int64_t>(std::ldexp(static_cast<double>(fraction), 60));
  const std::int64_t limit = product({length, 0, 0}, {scale.near_factor, 0, 0});
  exponent += scale.near_exponent - 60 - scale.finest_unit;
  if (scale.by_distance) return compressed(squared_length({limit, 0, 0}, exponent), 254);
  return zero_depth + compressed({static_cast<std::uint64_t>(limit), exponent}, 126);
}

}  // namespace

Depth depth_of(const float* position, const DepthKeyScale& scale) {
  const Place place = place_of(position, scale);
  if (!scale.by_distance) return depth_along_view(place, scale);
  Depth depth;
  depth.key = compressed(squared_length(place.axes, place.exponent), 254);
  depth.is_before_camera = place.axes[0] != 0 || place.axes[1] != 0 || place.axes[2] != 0;
  return depth;
}

bool is_within_limits(const Depth& depth, float h, const DepthKeyScale& scale) {
  return depth.is_before_camera && depth.key >= near_key(h, scale) && depth.key <= scale.far_key;
}

}  // namespace splotchcl::reference
