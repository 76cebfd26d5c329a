// Particles to splats. A work-item walks one block of particles and writes the visible
// ones one after the other from its own offset, so their order is the file's.

// The depth chain is compared bit for bit with the oracle (frame.h).
#pragma OPENCL FP_CONTRACT OFF

inline float3 camera_offset(__global const float* position, const ProjectParameters p) {
  return (float3)((position[0] - p.position_high[0]) - p.position_low[0],
                  (position[1] - p.position_high[1]) - p.position_low[1],
                  (position[2] - p.position_high[2]) - p.position_low[2]);
}

inline float chain_dot(float3 d, const float* axis) {
  return (d.x * axis[0] + d.y * axis[1]) + d.z * axis[2];
}

// Order-preserving: smaller floats become smaller integers, -0 and +0 the same one.
inline uint sort_key(float value, int descending) {
  const uint bits = as_uint(value == 0.0f ? 0.0f : value);
  const uint key = bits ^ ((bits >> 31) ? 0xffffffffu : 0x80000000u);
  return descending ? ~key : key;
}

inline float normalised(float value, const FieldScaling map) {
  float scaled = value;
  if (map.scaling == SCALING_LOG) scaled = log10(value);
  if (map.scaling == SCALING_ASINH) scaled = asinh(value);
  if (!isfinite(scaled)) return 0.0f;
  return clamp((scaled - map.minimum) * map.inverse_range, 0.0f, 1.0f);
}

// sigma_scaled is sigma in world units times length_scale.
inline float column_weight(float raw, float h, float sigma_scaled, const ProjectParameters p) {
  if (p.weight_model == WEIGHT_MASS) {
    return raw * p.weight_scale / sigma_scaled / sigma_scaled;
  }
  if (p.weight_model == WEIGHT_DENSITY) return raw * p.weight_scale * sigma_scaled;
  return p.weight_scale / (h * p.length_scale);
}

// What one particle becomes. 0: not visible, 1: visible, -1: bad values.
inline int project_particle(uint i, const ProjectParameters p, __global const Grid* grids,
                            __global const float* positions,
                            __global const float* smoothing_lengths,
                            __global const float* weights, __global const float* colors,
                            __global const float* intensities,
                            __global const float* sort_fields, Splat* splat, float* depth) {
  const float raw_h = smoothing_lengths[(size_t)i * p.smoothing_length_stride];
  const float raw_weight = weights[(size_t)i * p.weight_stride];
  const float raw_color = colors[(size_t)i * p.color_stride];
  const float raw_intensity = intensities[(size_t)i * p.intensity_stride];
  const float raw_sort = sort_fields[(size_t)i * p.sort_stride];
  const float3 d = camera_offset(positions + (size_t)i * 3, p);
  const float z = chain_dot(d, p.forward);
  *depth = z;

  const float h = raw_h * p.size_factor;
  if (!(isfinite(d.x) && isfinite(d.y) && isfinite(d.z) && isfinite(raw_h) && raw_h > 0.0f &&
        isfinite(raw_weight) && raw_weight >= 0.0f && isfinite(raw_color) &&
        isfinite(raw_intensity) && isfinite(raw_sort))) {
    return -1;
  }
  if (z < max(p.near_limit, p.near_factor * h) || z > p.far_limit) return 0;

  const float scale = p.perspective ? p.pixels_per_length / z : p.pixels_per_length;
  const float sigma_true = p.kernel_width * h * scale;
  const float sigma_floor = p.kernel_width * p.min_radius;
  const float sigma =
      p.min_radius > 0.0f ? sqrt(sigma_true * sigma_true + sigma_floor * sigma_floor) : sigma_true;
  float x = p.centre_x + chain_dot(d, p.right) * scale;
  float y = p.centre_y + chain_dot(d, p.down) * scale;

  // Cheap rejection before fields are scaled: six sigma reach beyond any truncation of
  // amplitudes up to 1e12.
  const float far_reach = 6.0f * sigma + 2.0f;
  const float width = (float)grids[0].width, height = (float)grids[0].height;
  if (x + far_reach < 0.0f || x - far_reach > width || y + far_reach < 0.0f ||
      y - far_reach > height) {
    return 0;
  }

  float weight = column_weight(raw_weight, h, p.kernel_width * h * p.length_scale, p) *
                 normalised(raw_intensity, p.intensity);
  if (p.min_radius > 0.0f) weight *= sigma_true / sigma;

  const int by_mean = sigma < p.mean_sigma;
  const float widened = by_mean ? sigma : sqrt(sigma * sigma + p.widening);
  if (!by_mean) weight *= (sigma / widened) * (sigma / widened);

  // The flux, not the peak, limits what a grain below a pixel can do to a pixel.
  const float peak = weight * p.peak_colour * min(1.0f, 3.2f * widened * widened);
  float extent = p.kernel_cut;
  if (extent == 0.0f) {
    extent = native_sqrt(max(0.0f, native_log(p.inverse_truncation * max(1.0f, peak))));
  }

  uint grid = 0;
  if (widened >= 2.0f * p.coarse_sigma) {
    const float amplified = p.coarse_sigma * max(1.0f, native_powr(peak, 0.125f));
    const float levels = native_log2(widened / amplified);
    grid = (uint)clamp((int)levels, 0, p.grid_count - 1);
  }
  const float shrink = as_float((127u - grid) << 23);
  const float sigma_grid = widened * shrink;
  const float radius = extent * sigma_grid + (by_mean ? 0.5f : 0.0f);
  x = x * shrink + (float)grids[grid].guard;
  y = y * shrink + (float)grids[grid].guard;
  const float r = reach(sigma_grid, radius, p.mean_sigma);
  if (x + r < 0.0f || x - r > (float)grids[grid].width || y + r < 0.0f ||
      y - r > (float)grids[grid].height) {
    return 0;
  }

  splat->x = x;
  splat->y = y;
  splat->sigma = sigma_grid;
  splat->radius = radius;
  splat->weight = weight;
  splat->color = normalised(raw_color, p.color);
  splat->component_and_grid = p.component | (grid << 16);
  return 1;
}

// visible[2 b] and visible[2 b + 1] take the block's numbers of visible and bad particles.
// With OUTPUT_SPLATS the splats are written from offsets[b] on; with OUTPUT_KEYS their
// sort keys and identity permutation, too.
__kernel void project(const ProjectParameters p, __global const Grid* grids,
                      __global const float* positions, __global const float* smoothing_lengths,
                      __global const float* weights, __global const float* colors,
                      __global const float* intensities, __global const float* sort_fields,
                      __global const uint* offsets, __global uint* visible,
                      __global Splat* splats, __global uint* keys, __global uint* order) {
  const uint block = get_global_id(0);
  const uint begin = p.first_particle + block * p.block_particles;
  const uint end = min(begin + p.block_particles, p.end_particle);
  uint count = 0, bad = 0;
  const uint numbered = p.first_block + block;
  uint slot = offsets[numbered];
  for (uint i = begin; i < end; ++i) {
    Splat splat;
    float depth;
    const int outcome = project_particle(i, p, grids, positions, smoothing_lengths, weights,
                                         colors, intensities, sort_fields, &splat, &depth);
    if (outcome > 0) {
#ifdef OUTPUT_SPLATS
      splats[slot] = splat;
#endif
#ifdef OUTPUT_KEYS
      const float value = p.sort_by_field ? sort_fields[(size_t)i * p.sort_stride] : depth;
      keys[slot] = sort_key(value, p.sort_descending);
      order[slot] = slot;
#endif
      ++slot;
      ++count;
    }
    bad += outcome < 0;
  }
  visible[2 * numbered] = count;
  visible[2 * numbered + 1] = bad;
}
