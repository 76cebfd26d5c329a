// Where the camera sees one particle, in extended numbers (extended.cl); view.cl has the same in
// single precision.
#include "kernels/common/grid.h"
#include "kernels/extended/extended.cl"
#include "kernels/project/depth_fade.cl"
#include "kernels/project/project.h"
#include "kernels/project/wide_angle_extended.cl"

#pragma OPENCL FP_CONTRACT OFF

typedef struct ExtendedPlace {
  Extended x, y;   // pixels of the whole picture
  Extended scale;  // pixels per length of a width
  Extended depth;  // where light fades with it
  int seen;
  Extended cos_latitude, sine_latitude;  // equirectangular
} ExtendedPlace;

static inline Extended extended_dot(const Extended* d, const FloatPair* axis) {
  return extended_sum(extended_sum(extended_product(d[0], extended_pair(axis[0])),
                                   extended_product(d[1], extended_pair(axis[1]))),
                      extended_product(d[2], extended_pair(axis[2])));
}

static inline void extended_offset(__global const float* position, const ExtendedParameters e,
                                   Extended* d) {
  for (int axis = 0; axis < 3; ++axis) {
    d[axis] = extended_difference(extended_of(position[axis]), extended_of(e.position[axis][0]));
    d[axis] = extended_difference(d[axis], extended_of(e.position[axis][1]));
    d[axis] = extended_difference(d[axis], extended_of(e.position[axis][2]));
  }
}

// n with 2^n <= the largest of the three < 2^(n + 1), in the range of extended_power_of_two().
static inline int exponent_of_largest(const Extended* d) {
  const float largest =
      max(fabs(high_part(d[0])), max(fabs(high_part(d[1])), fabs(high_part(d[2]))));
  return clamp((as_int(largest) >> 23) - 127, -126, 126);
}

// In units of a power of two near the distance, so that no length's unit matters.
static inline ExtendedPlace extended_place_in_wide_angle(__global const float* position,
                                                         const ExtendedParameters e) {
  Extended d[3], v[3];
  extended_offset(position, e, d);
  const int exponent = exponent_of_largest(d);
  const float per_unit = extended_power_of_two(-exponent);
  for (int axis = 0; axis < 3; ++axis)
    d[axis] = extended_scaled(d[axis], per_unit);
  v[0] = extended_dot(d, e.right);
  v[1] = extended_dot(d, e.down);
  v[2] = extended_dot(d, e.forward);
  const ExtendedWideAngle seen =
      extended_wide_angle(v, extended_scaled(extended_pair(e.eye_offset), per_unit), e);
  ExtendedPlace place;
  place.x = extended_sum(extended_pair(e.center_x), seen.x);
  place.y = extended_sum(extended_pair(e.center_y), seen.y);
  place.scale = extended_scaled(seen.scale, per_unit);
  place.depth = extended_scaled(seen.distance, extended_power_of_two(exponent));
  place.seen = seen.seen;
  place.cos_latitude = seen.cos_latitude;
  place.sine_latitude = seen.sine_latitude;
  return place;
}

static inline ExtendedPlace extended_place_in_plane(__global const float* position,
                                                    const ProjectParameters p,
                                                    const ExtendedParameters e) {
  Extended d[3];
  extended_offset(position, e, d);
  ExtendedPlace place;
  place.seen = 1;
  place.scale = extended_pair(e.pixels_per_length);
  place.depth = extended_of(0.0f);
  if (p.perspective || has_fade(p)) place.depth = extended_dot(d, e.forward);
  if (p.perspective) {
    // Depths have been compared with the limits as keys, and may be 0 here.
    Extended depth = place.depth;
    if (high_part(depth) < p.least_depth) depth = extended_of(p.least_depth);
    place.scale = extended_quotient(place.scale, depth);
  }
  place.x = extended_sum(extended_pair(e.center_x),
                         extended_product(extended_dot(d, e.right), place.scale));
  place.y = extended_sum(extended_pair(e.center_y),
                         extended_product(extended_dot(d, e.down), place.scale));
  return place;
}

static inline ExtendedPlace extended_place(__global const float* position,
                                           const ProjectParameters p, const ExtendedParameters e) {
  return WIDE_ANGLE ? extended_place_in_wide_angle(position, e)
                    : extended_place_in_plane(position, p, e);
}
