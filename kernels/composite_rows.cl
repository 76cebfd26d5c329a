// Compositing for processors with wide registers: a work-item takes a segment of one
// tile's list and updates rows of eight pixels in a private copy of the tile.
// Rows are padded on the right: a row of eight may start at any column.
#define ROW (TILE_WIDTH + 8)
#define TILE_PIXELS (TILE_HEIGHT * ROW)
#ifdef LIGHT_ORDERED
#define PLANES 6  // source S, then opacity 1 - exp(-tau)
#else
#define PLANES 3
#endif

inline void load_tile(float* tile, __global const float* planes, const Grid grid, size_t corner) {
  for (int c = 0; c < PLANES; ++c) {
    for (int y = 0; y < TILE_HEIGHT; ++y) {
      __global const float* row =
          planes + corner + (size_t)c * grid.plane_size + (size_t)y * grid.stride;
      for (int x = 0; x < TILE_WIDTH; x += 8) {
        vstore8(vload8(0, row + x), 0, tile + c * TILE_PIXELS + y * ROW + x);
      }
    }
  }
}

inline void store_tile(const float* tile, __global float* planes, const Grid grid, size_t corner) {
  for (int c = 0; c < PLANES; ++c) {
    for (int y = 0; y < TILE_HEIGHT; ++y) {
      __global float* row =
          planes + corner + (size_t)c * grid.plane_size + (size_t)y * grid.stride;
      for (int x = 0; x < TILE_WIDTH; x += 8) {
        vstore8(vload8(0, tile + c * TILE_PIXELS + y * ROW + x), 0, row + x);
      }
    }
  }
}

inline void store_partial(const float* tile, __global float* partial) {
  for (int c = 0; c < PLANES; ++c) {
    for (int y = 0; y < TILE_HEIGHT; ++y) {
      for (int x = 0; x < TILE_WIDTH; x += 8) {
        vstore8(vload8(0, tile + c * TILE_PIXELS + y * ROW + x), 0,
                partial + (c * TILE_HEIGHT + y) * TILE_WIDTH + x);
      }
    }
  }
}

// X / w of eight pixels, zero outside the cut.
inline float8 row_shape(float8 across, float along, float8 dx, float dy, float cut2) {
  const float8 shape = across * along;
#ifdef KERNEL_CUT
  const int8 outside = dx * dx + dy * dy > cut2;
#ifdef SAMPLING_MEAN
  const int8 home = fabs(dx) <= 0.5f & (int8)(fabs(dy) <= 0.5f ? -1 : 0);
  return select(shape, (float8)(0.0f), outside & ~home);
#else
  return select(shape, (float8)(0.0f), outside);
#endif
#else
  return shape;
#endif
}

#ifdef LIGHT_ORDERED
// The splat's layer behind what is already there: with u = (1 - opacity) X phi(A X),
// S grows by E u and opacity by A u. Opacity, not transmittance, is carried: it keeps
// optical depths of 1e-8.
#define COMPOSITE_ROWS(PHI)                                                      \
  for (int y = rows.x; y <= rows.y; ++y) {                                       \
    const int k = y - rows.x;                                                    \
    const float8 shape = row_shape(across, along[k], dx, dy0 + (float)k, cut2);  \
    float* pixel = tile + y * ROW + x;                                           \
    for (int c = 0; c < 3; ++c) {                                                \
      float* source = pixel + c * TILE_PIXELS;                                   \
      float* opacity = pixel + (c + 3) * TILE_PIXELS;                            \
      const float8 o = vload8(0, opacity);                                       \
      const float8 u = (1.0f - o) * (shape * PHI(shape * splat->light[c]));      \
      vstore8(vload8(0, source) + u * splat->emission[c], 0, source);            \
      vstore8(o + u * splat->light[c], 0, opacity);                              \
    }                                                                            \
  }
#endif

inline void add_splat(float* tile, __global const TileSplat* splat, const CompositeParameters p) {
  const int2 rows = pixel_range(splat->y, splat->radius, TILE_HEIGHT);
  const int2 columns = pixel_range(splat->x, splat->radius, TILE_WIDTH);
  if (rows.x > rows.y) return;
  const float sigma = splat->sigma;
  const float inverse = 1.44269504f / (sigma * sigma);
  const float cut2 = p.kernel_cut * p.kernel_cut * sigma * sigma;
  const float8 ramp = (float8)(0, 1, 2, 3, 4, 5, 6, 7);

  // One call of the shape serves eight rows: the Gaussian is separable.
  const float dy0 = (float)rows.x + 0.5f - splat->y;
  float along[TILE_HEIGHT + 8];
  for (int k = 0; k <= rows.y - rows.x; k += 8) {
    vstore8(axis_shape(dy0 + (float)k + ramp, sigma, inverse, p.mean_sigma), 0, along + k);
  }
#ifdef LIGHT_ORDERED
  const float deepest = max(splat->light[0], max(splat->light[1], splat->light[2])) *
                        (sigma < p.mean_sigma ? 3.15f * sigma * sigma : 1.0f);
#endif
  for (int x = columns.x; x <= columns.y; x += 8) {
    const float8 dx = (float)x + 0.5f - splat->x + ramp;
    const float8 across = axis_shape(dx, sigma, inverse, p.mean_sigma);
#ifdef LIGHT_ORDERED
    if (deepest <= p.phi_series) {
      COMPOSITE_ROWS(phi_series)
    } else {
      COMPOSITE_ROWS(phi_full)
    }
#else
    for (int y = rows.x; y <= rows.y; ++y) {
      const int k = y - rows.x;
      const float8 shape = row_shape(across, along[k], dx, dy0 + (float)k, cut2);
      float* pixel = tile + y * ROW + x;
      for (int c = 0; c < 3; ++c) {
        vstore8(vload8(0, pixel + c * TILE_PIXELS) + shape * splat->light[c], 0,
                pixel + c * TILE_PIXELS);
      }
    }
#endif
  }
}

#ifdef LIGHT_ORDERED
// Nothing behind shows any more: every channel of every pixel is opaque enough.
inline int is_opaque(const float* tile, float opaque) {
  float8 least = (float8)(2.0f);
  for (int c = 3; c < 6; ++c) {
    for (int y = 0; y < TILE_HEIGHT; ++y) {
      for (int x = 0; x < TILE_WIDTH; x += 8) {
        least = min(least, vload8(0, tile + c * TILE_PIXELS + y * ROW + x));
      }
    }
  }
  const float4 four = min(least.lo, least.hi);
  const float2 two = min(four.lo, four.hi);
  return min(two.x, two.y) >= opaque;
}
#endif

__kernel void composite(const CompositeParameters p, __global const Grid* grids,
                        __global const Segment* segments, __global const BinTotals* totals,
                        __global const TileSplat* entries, __global float* planes,
                        __global float* partials) {
  const uint id = get_global_id(0);
  if (id >= totals->segment_count) return;
  const Segment segment = segments[id];
  const Grid grid = grids[grid_of_tile(grids, p.grid_count, segment.tile)];
  const uint in_grid = segment.tile - grid.first_tile;
  const size_t corner = first_float(grid) +
                        (size_t)(in_grid / (uint)grid.tiles_x) * TILE_HEIGHT * grid.stride +
                        (size_t)(in_grid % (uint)grid.tiles_x) * TILE_WIDTH;
  float tile[PLANES * TILE_PIXELS];
  if (segment.partial == NO_PARTIAL) {
    load_tile(tile, planes, grid, corner);
  } else {
    for (int i = 0; i < PLANES * TILE_PIXELS; i += 8) vstore8((float8)(0.0f), 0, tile + i);
  }
  for (uint k = segment.begin; k < segment.end; ++k) {
#ifdef LIGHT_ORDERED
    if ((k - segment.begin) % 256u == 0u && is_opaque(tile, p.opaque)) break;
#endif
    add_splat(tile, entries + k, p);
  }
  if (segment.partial == NO_PARTIAL) {
    store_tile(tile, planes, grid, corner);
  } else {
    store_partial(tile, partials + (size_t)segment.partial * PLANES * TILE_WIDTH * TILE_HEIGHT);
  }
}
