// Particles to splats. A work-item walks one block of particles and writes the visible
// ones one after the other from its own offset, so their order is the file's.

// The depth chain is compared bit for bit with the oracle (frame.h).
#pragma OPENCL FP_CONTRACT OFF

// Order-preserving: smaller floats become smaller integers, -0 and +0 the same one.
inline uint sort_key(float value, int descending) {
  const uint bits = as_uint(value == 0.0f ? 0.0f : value);
  const uint key = bits ^ ((bits >> 31) ? 0xffffffffu : 0x80000000u);
  return descending ? ~key : key;
}

// LANES values from index i on; those from `end` on repeat the last one, since a mapped
// file may end with its last value. Stride 0: one value for all.
inline VALUE load_values(__global const float* values, uint i, uint end, int stride) {
  if (stride == 0) return (VALUE)(values[0]);
#ifdef LANES_8
  if (i + LANES > end) {
    float lanes[LANES];
    for (uint k = 0; k < LANES; ++k) lanes[k] = values[min(i + k, end - 1)];
    return vload8(0, lanes);
  }
#endif
  return LOAD(values + i);
}

typedef struct Offset {
  VALUE x, y, z;
} Offset;

inline Offset load_positions(__global const float* positions, uint i, uint end) {
  Offset p;
#ifdef LANES_8
  if (i + LANES <= end) {
    __global const float* first = positions + (size_t)i * 3;
    const float8 a = vload8(0, first), b = vload8(1, first), c = vload8(2, first);
    p.x = (float8)(a.s036, b.s147, c.s25);
    p.y = (float8)(a.s147, b.s25, c.s036);
    p.z = (float8)(a.s25, b.s036, c.s147);
    return p;
  }
  float x[LANES], y[LANES], z[LANES];
  for (uint k = 0; k < LANES; ++k) {
    __global const float* position = positions + (size_t)min(i + k, end - 1) * 3;
    x[k] = position[0];
    y[k] = position[1];
    z[k] = position[2];
  }
  p.x = vload8(0, x);
  p.y = vload8(0, y);
  p.z = vload8(0, z);
#else
  p.x = positions[(size_t)i * 3];
  p.y = positions[(size_t)i * 3 + 1];
  p.z = positions[(size_t)i * 3 + 2];
#endif
  return p;
}

inline Offset offset_from(Offset position, const float* high, const float* low) {
  Offset d;
  d.x = (position.x - high[0]) - low[0];
  d.y = (position.y - high[1]) - low[1];
  d.z = (position.z - high[2]) - low[2];
  return d;
}

inline VALUE chain_dot(Offset d, const float* axis) {
  return (d.x * axis[0] + d.y * axis[1]) + d.z * axis[2];
}

#ifdef WIDE_ANGLE
inline VALUE squared_distance(Offset d, float inverse_unit) {
  const VALUE x = d.x * inverse_unit, y = d.y * inverse_unit, z = d.z * inverse_unit;
  return (x * x + y * y) + z * z;
}
#endif

inline INTEGER is_finite(VALUE v) { return fabs(v) <= FLT_MAX; }

inline VALUE normalized(VALUE value, const FieldScaling map) {
  VALUE scaled = value;
  if (map.scaling == SCALING_LOG) {
    scaled = choose((VALUE)(-INFINITY), log2_positive(max(value, (VALUE)(1e-45f))) * 0.301029996f,
                    value > 0.0f);
  }
  if (map.scaling == SCALING_ASINH) scaled = asinh(value);
  const VALUE place = clamp(((scaled - map.minimum) - map.minimum_low) * map.inverse_range, (VALUE)(0.0f), (VALUE)(1.0f));
  return choose((VALUE)(0.0f), place, is_finite(scaled));
}

// w (scene.h, WeightModel); sigma_scaled is sigma in world units times length_scale.
inline VALUE column_weight(VALUE raw, VALUE h, const ProjectParameters p) {
  const VALUE sigma_scaled = p.kernel_width * h * p.length_scale;
  if (p.weight_model == WEIGHT_MASS) {
    return raw * p.weight_scale / sigma_scaled * p.weight_scale / sigma_scaled;
  }
  if (p.weight_model == WEIGHT_DENSITY) return raw * p.weight_scale * sigma_scaled;
  return raw * p.weight_scale / (h * p.length_scale);
}

// How many sigma a splat is drawn (docs/accuracy.md): at least so far that the light
// outside the square does not show in a sum of many, and for a bright one so far that
// its own edge does not show.
inline VALUE truncation_extent(VALUE peak, const ProjectParameters p) {
  const VALUE excess = log2_positive(max(peak * p.inverse_edge, (VALUE)(1.0f)));
  return max((VALUE)(p.least_extent), sqrt(0.693147181f * excess));
}

// The width below which a bright splat is taken as means. At the distance where it has faded
// to 1 the widened centre value errs by 5.6e-3 ln(peak)^2 / sigma^4 of what is there.
inline VALUE bright_mean_limit(VALUE peak, const ProjectParameters p) {
  const VALUE fading = 0.693147181f * log2_positive(max(peak, (VALUE)(1.0f)));
  return p.mean_sigma * sqrt(max(0.853f * fading, (VALUE)(1.0f)));
}

// The largest n with 2^n <= value, for positive values.
inline INTEGER power_of_two(VALUE value) { return (AS_INTEGER(value) >> 23) - 127; }

inline INTEGER grid_of_octave(INTEGER octave, VALUE peak, const ProjectParameters p) {
  const INTEGER grid = clamp(octave, (INTEGER)(0), (INTEGER)(p.grid_count - 1));
  return select(grid, (INTEGER)(0), peak > p.coarse_peak);
}

// The splats of LANES particles.
typedef struct SplatLanes {
  INTEGER visible, bad;
  INTEGER grid;
  VALUE x, y, sigma, radius, weight, color;
#ifdef ELLIPSES
  VALUE sigma_x, radius_x;
#endif
#ifdef VECTOR_COLORS
  VALUE red, green, blue;
#endif
  VALUE sort_value;
} SplatLanes;

// The particles' own colours, which are a parameter only where a component has some.
#ifdef VECTOR_COLORS
#define COLOR_VECTORS_PARAMETER , __global const float* color_vectors
#define COLOR_VECTORS_ARGUMENT , color_vectors
inline Offset load_vectors(__global const float* vectors, uint i, uint end, int stride) {
  if (stride != 0) return load_positions(vectors, i, end);
  Offset same;
  same.x = same.y = same.z = (VALUE)(vectors[0]);
  return same;
}
inline INTEGER is_color(VALUE v) { return v >= 0.0f & v <= FLT_MAX; }
#else
#define COLOR_VECTORS_PARAMETER
#define COLOR_VECTORS_ARGUMENT
#endif

// Particles from i on; those at or beyond `end` are neither visible nor bad.
inline SplatLanes project_lanes(uint i, uint end, const ProjectParameters p,
                                __global const Grid* grids, __global const float* positions,
                                __global const float* smoothing_lengths,
                                __global const float* weights, __global const float* colors,
                                __global const float* intensities,
                                __global const float* sort_fields COLOR_VECTORS_PARAMETER) {
  SplatLanes s;
#ifdef LANES_8
  const INTEGER exists = (INTEGER)(0, 1, 2, 3, 4, 5, 6, 7) < (INTEGER)(int)(end - i);
#else
  const INTEGER exists = 1;
#endif
  const VALUE raw_h = load_values(smoothing_lengths, i, end, p.smoothing_length_stride);
  const VALUE raw_weight = load_values(weights, i, end, p.weight_stride);
  const VALUE raw_color = load_values(colors, i, end, p.color_stride);
  const VALUE raw_intensity = load_values(intensities, i, end, p.intensity_stride);
  const VALUE raw_sort = load_values(sort_fields, i, end, p.sort_stride);
  const Offset position = load_positions(positions, i, end);
  const Offset d = offset_from(position, p.position_high, p.position_low);
#ifdef WIDE_ANGLE
  // Depth is the distance; its square orders as well, and has a chain of its own.
  const VALUE squared = squared_distance(d, p.length_scale);
  const VALUE z = sqrt(squared) / p.length_scale;
  s.sort_value = p.sort_by_field ? raw_sort : squared;
#else
  const VALUE z = chain_dot(d, p.forward);
  s.sort_value = p.sort_by_field ? raw_sort : z;
#endif

  INTEGER good = is_finite(d.x) & is_finite(d.y) & is_finite(d.z) & is_finite(raw_h) &
                       raw_h > 0.0f & is_finite(raw_weight) & raw_weight >= 0.0f &
                       is_finite(raw_color) & is_finite(raw_intensity) & is_finite(raw_sort);
#ifdef VECTOR_COLORS
  const Offset own = load_vectors(color_vectors, i, end, p.color_vector_stride);
  good &= is_color(own.x) & is_color(own.y) & is_color(own.z);
#endif
  s.bad = exists & (good == 0);

  const VALUE h = raw_h * p.size_factor;
#ifdef WIDE_ANGLE
  const Place place = place_in_wide_angle(chain_dot(d, p.right), chain_dot(d, p.down),
                                          chain_dot(d, p.forward), z, p);
  const VALUE scale = place.scale;
#else
  const VALUE scale = p.perspective ? p.pixels_per_length / z : (VALUE)(p.pixels_per_length);
#endif
  const VALUE sigma_true = p.kernel_width * h * scale;
  const float sigma_floor = p.kernel_width * p.min_radius;
  const VALUE sigma =
      p.min_radius > 0.0f ? sqrt(sigma_true * sigma_true + sigma_floor * sigma_floor) : sigma_true;
#ifdef WIDE_ANGLE
  const VALUE x = p.center_x + place.x, y = p.center_y + place.y;
#else
  // Across the view the look-at point serves as well as the camera. Seen from afar it is
  // much closer to the particle, and less is lost in the difference.
  const Offset l = offset_from(position, p.look_at_high, p.look_at_low);
  const INTEGER far_away = z > p.far_away;
  const VALUE across = choose(chain_dot(d, p.right), chain_dot(l, p.right), far_away);
  const VALUE along = choose(chain_dot(d, p.down), chain_dot(l, p.down), far_away);
  const VALUE x = p.center_x + across * scale;
  const VALUE y = p.center_y + along * scale;
#endif
#ifdef ELLIPSES
  const VALUE sigma_x = sigma_along_x(sigma, place.cos_latitude, p);
#endif

#ifdef EXACT_NUMBERS
  // Only what certainly lies off the picture; exact_splat() decides. Ten sigma reach beyond
  // the truncation of any amplitude that single precision holds.
  const VALUE rounding = 1e-6f * (fabs(d.x) + fabs(d.y) + fabs(d.z)) * fabs(scale);
  const VALUE reach = 10.0f * fabs(sigma) + 4.0f + rounding + 1e-4f * (fabs(x) + fabs(y));
  const INTEGER off = x + reach < 0.0f | x - reach > (float)grids[0].width | y + reach < 0.0f |
                      y - reach > (float)grids[0].height;
  s.visible = exists & good & (off == 0);
  return s;
#else
  // Rejection before fields are scaled: seven sigma reach beyond the truncation of any
  // amplitude that single precision can hold against the smallest tolerance.
  const VALUE far_reach = 7.0f * sigma + 2.0f;
  const float width = (float)grids[0].width, height = (float)grids[0].height;
  s.visible = exists & good & z >= (p.near_factor > 0.0f ? max(p.near_factor * h, (VALUE)(p.near_limit))
                                       : (VALUE)(p.near_limit)) &
              z <= p.far_limit & y + far_reach >= 0.0f & y - far_reach <= height;
#ifdef WIDE_ANGLE
  s.visible &= place.seen;
#endif
#ifndef ELLIPSES  // of these, copies beside the picture may reach it
  s.visible &= x + far_reach >= 0.0f & x - far_reach <= width;
#endif
  if (!ANY(s.visible)) return s;

  VALUE weight = column_weight(raw_weight, h, p) * normalized(raw_intensity, p.intensity);
  if (p.min_radius > 0.0f) weight *= sigma_true / sigma;
  // The flux, not the peak, limits what a grain below a pixel can do to a pixel.
  VALUE brightest = p.peak_color;
#ifdef VECTOR_COLORS
  brightest = max(brightest * max(own.x, max(own.y, own.z)), (VALUE)(p.peak_own));
#endif
#ifdef ELLIPSES
  const VALUE own_area = sigma * sigma_x;
#else
  const VALUE own_area = sigma * sigma;
#endif
  const INTEGER crowded = sigma >= p.crowd_narrowest & sigma <= p.crowd_widest;
  const VALUE own_peak = weight * brightest * min((VALUE)(1.0f), 3.2f * own_area);
  // What counts of a splat in a crowd is what all of them add up to.
  const VALUE peak = max(own_peak, choose((VALUE)(0.0f), (VALUE)(p.crowd_light), crowded));
  const INTEGER bright = own_peak > p.bright_peak | (crowded & (INTEGER)(p.crowd_bright > 0.0f ? -1 : 0));
  const VALUE mean_limit =
      choose((VALUE)(p.mean_sigma), bright_mean_limit(peak, p), bright);
  const INTEGER by_mean = sigma < mean_limit;
  const VALUE widened = choose(sqrt(sigma * sigma + p.widening), sigma, by_mean);
  const VALUE narrowing = sigma / widened;
#ifdef ELLIPSES
  const INTEGER by_mean_x = sigma_x < mean_limit;
  const VALUE widened_x = choose(sqrt(sigma_x * sigma_x + p.widening), sigma_x, by_mean_x);
  weight *= narrowing * (sigma_x / widened_x);
#else
  weight *= narrowing * narrowing;
#endif

  const VALUE crowd_extent = choose((VALUE)(0.0f), (VALUE)(p.crowd_extent), crowded);
  const VALUE extent =
      p.kernel_cut > 0.0f
          ? (VALUE)(p.kernel_cut)
          : max(truncation_extent(own_peak, p), crowd_extent);

  // Wide splats go to the coarsest grid that still shows their shape, bright ones finer.
  const VALUE amplified = p.coarse_sigma * sqrt(sqrt(sqrt(max(peak, (VALUE)(1.0f)))));
  const VALUE ratio = widened / amplified;
  INTEGER level;
  if (p.bands) {
    s.grid = grid_of_octave(power_of_two(ratio * ratio) - 1, peak, p);
    level = (s.grid + 1) >> 1;
  } else {
    s.grid = grid_of_octave(power_of_two(ratio), peak, p);
    level = s.grid;
  }
  const VALUE shrink = AS_VALUE((127 - level) << 23);
  s.sigma = widened * shrink;
  if (p.bands) {
    // The grid's blur widens what is drawn to the splat's width, and spreads its light.
    const VALUE blur = choose((VALUE)(p.blur[1]), (VALUE)(p.blur[0]), (s.grid & 1) != 0);
    const VALUE drawn = sqrt(s.sigma * s.sigma - blur);
    const VALUE spread = s.sigma / drawn;
    weight *= choose((VALUE)(1.0f), spread * spread, s.grid > 0);
    s.sigma = choose(s.sigma, drawn, s.grid > 0);
  }
  // A pixel mean sees a splat that reaches the pixel's edge. A cut disc has the radius of
  // the model's sigma, not of the widened one, and means always keep the pixel at its centre.
  s.radius = p.kernel_cut > 0.0f
                 ? p.kernel_cut * sigma * shrink + (p.widening > 0.0f ? 0.5f : 0.0f)
                 : extent * s.sigma + choose((VALUE)(0.0f), (VALUE)(0.5f), by_mean);
#ifdef ELLIPSES
  // Such pictures have no coarse grids.
  s.sigma_x = widened_x;
  s.radius_x = p.kernel_cut > 0.0f
                   ? p.kernel_cut * sigma_x + (p.widening > 0.0f ? 0.5f : 0.0f)
                   : extent * widened_x + choose((VALUE)(0.0f), (VALUE)(0.5f), by_mean_x);
#endif
  const VALUE guard = choose((VALUE)(0.0f), (VALUE)(p.guard), s.grid > 0);
  s.x = x * shrink + guard;
  s.y = y * shrink + guard;
#ifndef ELLIPSES
  s.visible &= s.x + s.radius >= 0.0f & s.x - s.radius <= width * shrink + 2.0f * guard + 1.0f;
#endif
  s.visible &= s.y + s.radius >= 0.0f & s.y - s.radius <= height * shrink + 2.0f * guard + 1.0f;
  // Half of the light beyond the square goes back into it: the sum of many errs by as much
  // above as below. Means are drawn in all pixels that the square touches, half a pixel more
  // on average and for a grain nearly everything: with t / sigma more, erfc(k) falls as
  // exp(-2 k t / sigma), whose mean over t from 0 to 1 is close to sigma / (sigma + 2 k).
  const INTEGER faint = extent <= p.least_extent;
  const VALUE cut_off = choose((VALUE)(1.0f), sigma / (sigma + 2.0f * extent), by_mean);
  s.weight = choose(weight, weight * (1.0f + p.restored_light * cut_off), faint);
  s.color = normalized(raw_color, p.color);
  s.sigma = choose(s.sigma, -s.sigma, bright & by_mean);
#ifdef ELLIPSES
  s.sigma_x = choose(s.sigma_x, -s.sigma_x, bright & by_mean_x);
#endif
#ifdef VECTOR_COLORS
  s.red = own.x;
  s.green = own.y;
  s.blue = own.z;
#endif
  return s;
#endif
}

#ifdef LANES_8
#define LANE(v, k) v##_lanes[k]
#define SPREAD(type, v) \
  type v##_lanes[LANES]; \
  vstore8(s.v, 0, v##_lanes);
#else
#define LANE(v, k) s.v
#define SPREAD(type, v)
#endif

// What the exact mode needs beyond that (project_exact.cl).
#ifdef EXACT_NUMBERS
#ifndef VECTOR_COLORS
#define color_vectors colors
#endif
#define EXACT_PARAMETERS                                                          \
  , const ExactParameters e, __global const ComponentColors *component_colors,    \
      __global const float *knots, __global ExactSplat *exact_splats
#else
#define EXACT_PARAMETERS
#endif

// visible[2 b] and visible[2 b + 1] take the block's numbers of visible and bad particles.
// With OUTPUT_SPLATS the splats are written from offsets[b] on; with OUTPUT_KEYS their
// sort keys and identity permutation, too.
__kernel void project(const ProjectParameters p, __global const Grid* grids,
                      __global const float* positions, __global const float* smoothing_lengths,
                      __global const float* weights, __global const float* colors,
                      __global const float* intensities, __global const float* sort_fields,
                      __global const uint* offsets, __global uint* visible,
                      __global Splat* splats, __global uint* keys,
                      __global uint* order COLOR_VECTORS_PARAMETER EXACT_PARAMETERS) {
  const uint block = get_global_id(0);
  const uint begin = p.first_particle + block * p.block_particles;
  const uint end = min(begin + p.block_particles, p.end_particle);
  const uint numbered = p.first_block + block;
  const uint first_slot = offsets[numbered];
  uint slot = first_slot, bad_count = 0;
  for (uint i = begin; i < end; i += LANES) {
    const SplatLanes s = project_lanes(i, end, p, grids, positions, smoothing_lengths, weights,
                                       colors, intensities, sort_fields COLOR_VECTORS_ARGUMENT);
    if (ANY(s.bad)) {
      SPREAD(int, bad)
      for (uint k = 0; k < LANES; ++k) bad_count += LANE(bad, k) != 0;
    }
    if (!ANY(s.visible)) continue;
    SPREAD(int, visible)
#if defined(OUTPUT_SPLATS) && !defined(EXACT_NUMBERS)
#ifndef ELLIPSES
    SPREAD(float, x)
#endif
    SPREAD(float, y)
    SPREAD(float, sigma)
    SPREAD(float, radius)
    SPREAD(float, weight)
    SPREAD(float, color)
#ifdef VECTOR_COLORS
    SPREAD(float, red)
    SPREAD(float, green)
    SPREAD(float, blue)
#endif
    SPREAD(int, grid)
#endif
#ifdef OUTPUT_KEYS
    SPREAD(float, sort_value)
#endif
#ifdef ELLIPSES
    SPREAD(float, x)
    SPREAD(float, radius_x)
#ifdef OUTPUT_SPLATS
    SPREAD(float, sigma_x)
#endif
#endif
    for (uint k = 0; k < LANES; ++k) {
      if (!LANE(visible, k)) continue;
#ifdef ELLIPSES
      const int2 copies =
          copies_in_picture(LANE(x, k), LANE(radius_x, k), (float)grids[0].width, p.period);
      for (int copy = copies.x; copy <= copies.y; ++copy) {
#endif
#ifdef EXACT_NUMBERS
      Splat found;
      ExactSplat exact;
      if (!exact_splat(i + k, p, e, grids, positions, smoothing_lengths, weights, colors,
                       intensities, color_vectors, component_colors, knots, &found, &exact)) {
        continue;
      }
#ifdef OUTPUT_SPLATS
      found.component_and_grid = p.component;
      splats[slot] = found;
      exact_splats[slot] = exact;
#endif
#elif defined(OUTPUT_SPLATS)
      __global Splat* splat = splats + slot;
#ifdef ELLIPSES
      splat->x = LANE(x, k) + (float)copy * p.period;
#else
      splat->x = LANE(x, k);
#endif
      splat->y = LANE(y, k);
      splat->sigma = LANE(sigma, k);
      splat->radius = LANE(radius, k);
#ifdef ELLIPSES
      splat->sigma_x = LANE(sigma_x, k);
      splat->radius_x = LANE(radius_x, k);
#endif
      splat->weight = LANE(weight, k);
      splat->color = LANE(color, k);
#ifdef VECTOR_COLORS
      splat->vector[0] = LANE(red, k);
      splat->vector[1] = LANE(green, k);
      splat->vector[2] = LANE(blue, k);
#endif
      splat->component_and_grid = p.component | ((uint)LANE(grid, k) << 16);
#endif
#ifdef OUTPUT_KEYS
      keys[slot] = sort_key(LANE(sort_value, k), p.sort_descending);
      order[slot] = slot;
#endif
      ++slot;
#ifdef ELLIPSES
      }
#endif
    }
  }
  visible[2 * numbered] = slot - first_slot;
  visible[2 * numbered + 1] = bad_count;
}
