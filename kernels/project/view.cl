// Where the camera sees a particle: its depth and its place in the picture.
#include "kernels/common/common.cl"
#include "kernels/common/lanes.cl"
#include "kernels/project/load.cl"
#include "kernels/project/project.h"
#include "kernels/project/wide_angle_point.cl"

// A chain of differences: none is to be joined with the product behind it.
#pragma OPENCL FP_CONTRACT OFF

INLINED Vectors offset_from(Vectors position, const REAL* high, const REAL* low) {
  Vectors d;
  d.x = (position.x - high[0]) - low[0];
  d.y = (position.y - high[1]) - low[1];
  d.z = (position.z - high[2]) - low[2];
  return d;
}

static inline VALUE along(Vectors d, const REAL* axis) {
  return (d.x * axis[0] + d.y * axis[1]) + d.z * axis[2];
}

static inline VALUE squared_distance(Vectors d, REAL inverse_unit) {
  const VALUE x = d.x * inverse_unit, y = d.y * inverse_unit, z = d.z * inverse_unit;
  return (x * x + y * y) + z * z;
}

static inline VALUE sum_of_sizes(Vectors d) {
  return fabs(d.x) + fabs(d.y) + fabs(d.z);
}

typedef struct ViewLanes {
  Vectors offset;            // from the camera, in lengths
  VALUE depth;               // along the view direction; in wide angles the distance
  VALUE x, x_low, y, y_low;  // pixels from the picture's middle
  VALUE scale;               // pixels per length of a width
  VALUE place_error;         // of x and y, in roundings: 2^-24 pixels (docs/dev/accuracy.md)
  INTEGER seen;              // of wide angles: what they show
  VALUE cos_latitude, sine_latitude;  // equirectangular
} ViewLanes;

INLINED ViewLanes view_in_wide_angle(const ParticleLanes particles, const ProjectParameters p) {
  ViewLanes view;
  const Vectors d = offset_from(particles.position, p.position_high, p.position_low);
  const VALUE squared = squared_distance(d, p.length_scale);
  view.offset = d;
  view.depth = sqrt(squared) / p.length_scale;
  const WideAnglePoint point =
      project_wide_angle(along(d, p.right), along(d, p.down), along(d, p.forward), view.depth,
                         p.pixels_per_length, p.eye_offset, p.turn_axis);
  view.x = p.center_x + point.x;
  view.y = p.center_y + point.y;
  view.scale = point.scale;
  view.seen = point.seen;
  view.cos_latitude = point.cos_latitude;
  view.sine_latitude = point.sine_latitude;
  view.x_low = view.y_low = (VALUE)(0.0f);
  view.place_error = 10.0f * p.pixels_per_length * point.magnification +
                     p.place_error_per_pixel * max(fabs(view.x), fabs(view.y)) + p.place_error;
  return view;
}

INLINED ViewLanes view_in_plane(const ParticleLanes particles, const ProjectParameters p) {
  ViewLanes view;
  view.seen = (INTEGER)(-1);
  view.cos_latitude = view.sine_latitude = (VALUE)(0.0f);
  const Vectors d = offset_from(particles.position, p.position_high, p.position_low);
  view.offset = d;
  view.depth = along(d, p.forward);
  view.scale = p.perspective ? p.pixels_per_length / max(view.depth, (VALUE)(p.least_depth))
                             : (VALUE)(p.pixels_per_length);
  // Across the view the look-at point serves as well as the camera. Seen from afar it is
  // much closer to the particle, and less is lost in the difference.
  const Vectors l = offset_from(particles.position, p.look_at_high, p.look_at_low);
  const INTEGER far_away = view.depth > p.far_away;
  const VALUE right = choose(along(d, p.right), along(l, p.right), far_away);
  const VALUE down = choose(along(d, p.down), along(l, p.down), far_away);
  view.x = p.center_x + right * view.scale;
  view.y = p.center_y + down * view.scale;
  view.x_low = view.y_low = (VALUE)(0.0f);
  const VALUE across = choose(sum_of_sizes(d), sum_of_sizes(l), far_away);
  view.place_error = 6.0f * across * view.scale +
                     p.place_error_per_pixel * max(fabs(view.x), fabs(view.y)) + p.place_error;
  return view;
}

INLINED ViewLanes view_particles(const ParticleLanes particles, const ProjectParameters p) {
  return WIDE_ANGLE ? view_in_wide_angle(particles, p) : view_in_plane(particles, p);
}

// What single precision says of the near and far limits.
typedef struct LimitLanes {
  INTEGER may_be_within;
  INTEGER unclear;  // of those: so close to a limit that depth keys have to decide
} LimitLanes;

INLINED LimitLanes compare_with_limits(const ViewLanes view, VALUE h, const ProjectParameters p) {
  const Vectors d = view.offset;
  const VALUE rounding = 2e-6f * sum_of_sizes(d) + p.depth_rounding;
  const VALUE nearest =
      p.near_factor > 0.0f ? max(p.near_factor * h, (VALUE)(p.near_limit)) : (VALUE)(p.near_limit);
  const VALUE inside = min(view.depth - nearest, p.far_limit - view.depth);
  LimitLanes limits;
  limits.may_be_within = inside >= -rounding;
  limits.unclear = inside <= rounding;
  return limits;
}

// Clouds around the camera, which are no splats: the host draws them. Good particles from so many
// sigma on are splats; `offset` is from the camera.
INLINED INTEGER are_around(VALUE h, const Vectors offset, const ProjectParameters p) {
  const VALUE reach = p.around_reach * h;
  return squared_distance(offset, p.length_scale) < reach * reach;
}
