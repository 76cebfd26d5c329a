#include "scene/depth_key.h"

#include <algorithm>
#include <cmath>

#include "scene/particle_rules.h"

namespace splotchcl {
namespace {

constexpr std::uint64_t zero_depth = std::uint64_t{1} << (depth_key_bits - 1);
constexpr std::uint64_t largest_key = (std::uint64_t{1} << depth_key_bits) - 1;

// A number as magnitude * 2^exponent, magnitude < 2^60. All 53 bits of a double fit.
struct Scaled {
  std::uint64_t magnitude = 0;
  int exponent = 0;
};

Scaled scaled(double value) {
  Scaled result;
  const double fraction = std::frexp(std::abs(value), &result.exponent);
  result.magnitude = static_cast<std::uint64_t>(std::ldexp(fraction, 60));
  result.exponent -= 60;
  return result;
}

int leading_zeros(std::uint64_t value) {
  int zeros = 0;
  for (std::uint64_t bit = std::uint64_t{1} << 63; bit != 0 && (value & bit) == 0; bit >>= 1)
    ++zeros;
  return zeros;
}

// The exponent of the leading bit beyond the 41st, and the leading 41 bits, as one number: it
// grows with magnitude * 2^exponent, and is that itself below 2^41.
std::uint64_t compressed(const Scaled& value, int largest_exponent) {
  if (value.magnitude == 0) return 0;
  const int bits = 64 - leading_zeros(value.magnitude) + value.exponent;
  const int beyond = std::max(0, bits - 41);
  if (beyond > largest_exponent) {
    return (static_cast<std::uint64_t>(largest_exponent + 2) << 40) - 1;
  }
  const int shift = beyond - value.exponent;
  const std::uint64_t leading =
      shift >= 0 ? value.magnitude >> std::min(shift, 63) : value.magnitude << -shift;
  return (static_cast<std::uint64_t>(beyond) << 40) + leading;
}

Scaled squared(const Scaled& value) {
  if (value.magnitude == 0) return {};
  const int doublings = leading_zeros(value.magnitude) - 4;
  const std::uint64_t length = value.magnitude << doublings;
  const std::uint64_t high = length >> 30, low = length & 0x3fffffffu;
  return {high * high + (high * low >> 29), 60 + 2 * (value.exponent - doublings)};
}

void set_limits(const Frame& frame, const DrawnComponent& component, DepthKeyScale& scale) {
  scale.far_key = frame.far_limit ? key_of_depth(*frame.far_limit, scale) : largest_key;
  if (frame.near_limit || frame.projection == Projection::orthographic) {
    scale.near_key = key_of_depth(frame.near_limit.value_or(0), scale);
    return;
  }
  const Scaled factor = scaled(near_smoothing_lengths * component.size_factor);
  scale.near_factor = static_cast<std::int64_t>(factor.magnitude);
  scale.near_exponent = factor.exponent + 60;
}

// a - b as a sum of two doubles, exactly (Knuth).
struct Difference {
  double high, low;
};

Difference exact_difference(double a, double b) {
  const double high = a - b;
  const double part = high - a;
  return {high, (a - (high - part)) - (b + part)};
}

std::int64_t in_units(const Difference& length, int unit) {
  return std::llround(std::ldexp(length.high, -unit)) + std::llround(std::ldexp(length.low, -unit));
}

}  // namespace

std::uint64_t key_of_depth(double depth, const DepthKeyScale& scale) {
  if (scale.by_distance && depth <= 0) return 0;
  Scaled finest = scaled(depth);
  finest.exponent -= scale.finest_unit;
  if (scale.by_distance) return compressed(squared(finest), 254);
  const std::uint64_t magnitude = compressed(finest, 126);
  return depth < 0 ? zero_depth - magnitude : zero_depth + magnitude;
}

DepthKeyScale make_depth_key_scale(const Frame& frame, const DrawnComponent& component) {
  const CameraFrame& camera = frame.camera;
  DepthKeyScale scale;
  scale.by_distance = is_wide_angle(frame.projection);
  scale.is_perspective = frame.projection == Projection::perspective;
  // The look-at distance has 59 bits.
  scale.finest_unit = std::ilogb(camera.look_at_distance) - 58;
  scale.unit = scale.finest_unit;
  Difference from_camera[3];
  for (int axis = 0; axis < 3; ++axis) {
    Difference& length = from_camera[axis];
    length = exact_difference(component.particles.origin.a[axis], camera.position.a[axis]);
    if (length.high != 0) scale.unit = std::max(scale.unit, std::ilogb(length.high) - 58);
  }
  for (int axis = 0; axis < 3; ++axis) {
    scale.origin_from_camera[axis] = in_units(from_camera[axis], scale.unit);
    scale.forward[axis] = std::llround(std::ldexp(camera.forward.a[axis], 60));
  }
  set_limits(frame, component, scale);
  return scale;
}

}  // namespace splotchcl
