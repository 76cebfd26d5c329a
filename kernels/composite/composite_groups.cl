// Compositing for GPUs: a work-group takes a segment of one tile's list, a work-item one
// pixel. The group stages splats in local memory, a batch at a time. Formulas are those of
// composite_rows.cl, on single floats.
#define GROUP (TILE_WIDTH * TILE_HEIGHT)
// One axis of the separable shape at distance d of a pixel's centre.
inline float axis_shape(float d, float sigma, float inverse, float mean_sigma) {
  if (sigma < 0.0f) return bright_mean(d, -sigma);
  if (sigma >= mean_sigma) return gaussian(d, inverse);
  const float per_sigma = 1.0f / sigma;
  return PIXEL_MEAN_SCALE * sigma *
         (error_function((d + 0.5f) * per_sigma) - error_function((d - 0.5f) * per_sigma));
}

// X / w of one pixel; zero outside what the rows would draw.
inline float pixel_shape(float dx, float dy, const TileSplat splat, float mean_sigma) {
  if (fabs(dx) > RADIUS_X(splat) || fabs(dy) > splat.radius) return 0.0f;
  const float sigma = splat.sigma;
  const float inverse = 1.44269504f / (sigma * sigma);
#ifdef KERNEL_CUT
  const float cut = cut_radius(splat.radius);
#ifdef ELLIPSES
  const float round_dx = dx * (cut / cut_radius(splat.along_x.radius));
#else
  const float round_dx = dx;
#endif
  int inside = round_dx * round_dx + dy * dy <= cut * cut;
#ifdef SAMPLING_MEAN
  inside |= dx > -0.5f && dx <= 0.5f && dy > -0.5f && dy <= 0.5f;
#endif
  if (!inside) return 0.0f;
#endif
#ifdef ELLIPSES
  const float sigma_x = splat.along_x.sigma, inverse_x = 1.44269504f / (sigma_x * sigma_x);
#else
  const float sigma_x = sigma, inverse_x = inverse;
#endif
  return axis_shape(dx, sigma_x, inverse_x, mean_sigma) *
         axis_shape(dy, sigma, inverse, mean_sigma);
}

inline void add_splat(float* pixel, const TileSplat splat, float shape, float phi_series_limit) {
  for (int c = 0; c < 3; ++c) {
#ifdef LIGHT_ORDERED
    const float tau = shape * splat.absorption[c];
    const int by_series = tau <= phi_series_limit;
    const float phi = by_series ? phi_series(tau) : phi_full(tau);
    const float passed = by_series ? passed_by_series(tau, phi) : passed_in_full(tau, phi);
    const float t = transmittance_of(pixel[c + 3]);
    const float u = t * (shape * phi);
    pixel[c] += u * splat.emission[c];
    pixel[c + 3] = carry(pixel[c + 3], u * splat.absorption[c], t * passed);
#else
    pixel[c] += shape * splat.summed[c];
#endif
  }
}

// A block of splats behind what is in front of it (composite_rows.cl, SPLATS_OF_BLOCK).
inline void add_block(float* block, float* front) {
  for (int c = 0; c < 3; ++c) {
#ifdef LIGHT_ORDERED
    const float t = transmittance_of(front[c + 3]);
    front[c] += t * block[c];
    front[c + 3] = carry_behind(front[c + 3], t, block[c + 3]);
    block[c + 3] = 0.0f;
#else
    front[c] += block[c];
#endif
    block[c] = 0.0f;
  }
}

// Whether it reaches a pixel's center.
inline uint touches_tile(const TileSplat splat) {
  return fabs(splat.x) <= 0.5f * TILE_WIDTH - 0.5f + RADIUS_X(splat) &&
         fabs(splat.y) <= 0.5f * TILE_HEIGHT - 0.5f + splat.radius;
}

__kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void composite(
    const CompositeParameters p, __global const Grid* grids, __global const Segment* segments,
    __global const TileSplat* entries, __global float* planes, __global float* partials) {
  __local TileSplat batch[GROUP];
  const uint item = get_local_id(0);
  // The launch has as many groups as there are segments.
  const Segment segment = segments[get_group_id(0)];
  const Grid grid = grids[grid_of_tile(grids, p.grid_count, segment.tile)];
  const uint in_grid = segment.tile - grid.first_tile;
  const uint x = item % TILE_WIDTH, y = item / TILE_WIDTH;
  __global float* own = planes + first_float(grid) +
                        ((size_t)(in_grid / (uint)grid.tiles_x) * TILE_HEIGHT + y) * grid.stride +
                        (size_t)(in_grid % (uint)grid.tiles_x) * TILE_WIDTH + x;
  float front[PLANES], pixel[PLANES];
  for (int c = 0; c < PLANES; ++c) {
    front[c] = segment.partial == NO_PARTIAL ? own[(size_t)c * grid.plane_size] : 0.0f;
    pixel[c] = 0.0f;
  }
  // Blocks are of splats that touch the tile: a crop's lists have others than those of the picture,
  // too.
  uint touching = 0;
  // begin and end are the group's: every item meets every barrier.
  for (uint first = segment.begin; first < segment.end; first += GROUP) {
    const uint count = min((uint)GROUP, segment.end - first);
    if (item < count) batch[item] = entries[first + item];
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint k = 0; k < count; ++k) {
      const TileSplat splat = batch[k];
      const float dx = (float)x + (0.5f - 0.5f * TILE_WIDTH) - splat.x - LOW_X(splat);
      const float dy = (float)y + (0.5f - 0.5f * TILE_HEIGHT) - splat.y - LOW_Y(splat);
      const float shape = pixel_shape(dx, dy, splat, grid.mean_sigma);
      if (shape > 0.0f) add_splat(pixel, splat, shape, p.phi_series);
      touching += touches_tile(splat);
      if (touching < SPLATS_OF_BLOCK) continue;
      touching = 0;
      add_block(pixel, front);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  add_block(pixel, front);
  for (int c = 0; c < PLANES; ++c) {
    if (segment.partial == NO_PARTIAL) {
      own[(size_t)c * grid.plane_size] = front[c];
    } else {
      partials[((size_t)segment.partial * PLANES + c) * GROUP + item] = front[c];
    }
  }
}
