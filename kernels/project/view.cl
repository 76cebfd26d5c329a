// Where the camera sees a particle: its depth, its sort key and its place in the picture.

// The depth chain is compared bit for bit with the reference (frame.h).
#pragma OPENCL FP_CONTRACT OFF

// Order-preserving: smaller floats become smaller integers, -0 and +0 the same one.
inline uint sort_key(float value, int descending) {
  const uint bits = as_uint(value == 0.0f ? 0.0f : value);
  const uint key = bits ^ ((bits >> 31) ? 0xffffffffu : 0x80000000u);
  return descending ? ~key : key;
}

INLINED Vectors offset_from(Vectors position, const float* high, const float* low) {
  Vectors d;
  d.x = (position.x - high[0]) - low[0];
  d.y = (position.y - high[1]) - low[1];
  d.z = (position.z - high[2]) - low[2];
  return d;
}

inline VALUE chain_dot(Vectors d, const float* axis) {
  return (d.x * axis[0] + d.y * axis[1]) + d.z * axis[2];
}

inline VALUE squared_distance(Vectors d, float inverse_unit) {
  const VALUE x = d.x * inverse_unit, y = d.y * inverse_unit, z = d.z * inverse_unit;
  return (x * x + y * y) + z * z;
}

typedef struct ViewLanes {
  Vectors offset;  // from the camera, in lengths
  VALUE depth;     // along the view direction; in wide angles the distance
  VALUE sort_value;
  VALUE x, y;   // pixels of the crop
  VALUE scale;  // pixels per length of a width
#ifdef WIDE_ANGLE
  INTEGER seen;
  VALUE cos_latitude;  // equirectangular
#endif
} ViewLanes;

#ifdef WIDE_ANGLE
// Depth is the distance; its square orders as well, and has a chain of its own.
INLINED ViewLanes view_particles(const ParticleLanes particles, const ProjectParameters p) {
  ViewLanes view;
  const Vectors d = offset_from(particles.position, p.position_high, p.position_low);
  const VALUE squared = squared_distance(d, p.length_scale);
  view.offset = d;
  view.depth = sqrt(squared) / p.length_scale;
  view.sort_value = p.sort_by_field ? particles.sort_field : squared;
  const WideAnglePoint point = project_wide_angle(chain_dot(d, p.right), chain_dot(d, p.down),
                                                  chain_dot(d, p.forward), view.depth, p);
  view.x = p.center_x + point.x;
  view.y = p.center_y + point.y;
  view.scale = point.scale;
  view.seen = point.seen;
  view.cos_latitude = point.cos_latitude;
  return view;
}
#else
INLINED ViewLanes view_particles(const ParticleLanes particles, const ProjectParameters p) {
  ViewLanes view;
  const Vectors d = offset_from(particles.position, p.position_high, p.position_low);
  view.offset = d;
  view.depth = chain_dot(d, p.forward);
  view.sort_value = p.sort_by_field ? particles.sort_field : view.depth;
  view.scale = p.perspective ? p.pixels_per_length / view.depth : (VALUE)(p.pixels_per_length);
  // Across the view the look-at point serves as well as the camera. Seen from afar it is
  // much closer to the particle, and less is lost in the difference.
  const Vectors l = offset_from(particles.position, p.look_at_high, p.look_at_low);
  const INTEGER far_away = view.depth > p.far_away;
  const VALUE across = choose(chain_dot(d, p.right), chain_dot(l, p.right), far_away);
  const VALUE along = choose(chain_dot(d, p.down), chain_dot(l, p.down), far_away);
  view.x = p.center_x + across * view.scale;
  view.y = p.center_y + along * view.scale;
  return view;
}
#endif

inline INTEGER is_within_depth(VALUE depth, VALUE h, const ProjectParameters p) {
  return depth >= (p.near_factor > 0.0f ? max(p.near_factor * h, (VALUE)(p.near_limit))
                                        : (VALUE)(p.near_limit)) &
         depth <= p.far_limit;
}
