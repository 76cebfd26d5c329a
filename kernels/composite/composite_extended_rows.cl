// Compositing in double precision for processors with wide registers: as in composite_rows.cl a
// work-item takes a segment of one tile's list and updates rows of eight pixels in a private copy
// of the tile. In the ordered plan it holds transmittances: doubles of them lose no digits to
// layers, since each is multiplied by what the next layer lets through.
#define SUMS 3
#ifdef LIGHT_ORDERED
#define TILE_PLANES 6
#else
#define TILE_PLANES 3
#endif
#define DARKEST 1e-300  // of transmittances: their logarithm is a number

inline double in_full(FloatPair a) {
  return (double)a.high + (double)a.low;
}

// A splat's shape along one axis of the tile, and what decides whether a pixel is in a cut disc.
typedef struct Axis {
  double shape[TILE_WIDTH + 8];  // tiles are no higher than wide
#ifdef KERNEL_CUT
  double square[TILE_WIDTH + 8];  // of the distance
  long holds[TILE_WIDTH + 8];     // -1 where the pixel holds the center: it begins at its own edge
#endif
  int first, last;  // pixels; none where last < first
} Axis;

inline double8 ramp_of_eight() {
  return (double8)(0, 1, 2, 3, 4, 5, 6, 7);
}

// The mean of exp(-d^2 / sigma^2) over pixels from 1 - erf of the distances of their edges.
inline double8 mean_of_complements(double8 left, double8 of_left, double8 right, double8 of_right) {
  const double8 beside = select(of_right - of_left, of_left - of_right, left >= 0.0);
  return select(beside, 2.0 - of_left - of_right, (left < 0.0) & (right > 0.0));
}

inline void fill_means(double* values, double first, int begin, int end, double sigma) {
  double beyond[TILE_WIDTH + 16];
  const double per_sigma = 1.0 / sigma;
  for (int k = begin; k <= end; k += 8) {
    const double8 edge = (first - 0.5 + (double)k + ramp_of_eight()) * per_sigma;
    vstore8(complement_of_erf(fabs(edge)), 0, beyond + k);
  }
  for (int k = begin; k < end; k += 8) {
    const double8 left = (first - 0.5 + (double)k + ramp_of_eight()) * per_sigma;
    const double8 right = (first + 0.5 + (double)k + ramp_of_eight()) * per_sigma;
    const double8 mean =
        mean_of_complements(left, vload8(0, beyond + k), right, vload8(0, beyond + k + 1));
    vstore8(mean * (0.88622692545275805 * sigma), 0, values + k);
  }
}

inline void fill_centers(double* values, double first, int begin, int end, double sigma) {
  for (int k = begin; k < end; k += 8) {
    const double8 u = (first + (double)k + ramp_of_eight()) / sigma;
    vstore8(exp_of_minus(min(u * u, (double8)(700.0))), 0, values + k);
  }
}

// Pixels of a tile of `size`, the first of which has its center at `corner`, in whole eights;
// nothing beyond the radius. `squeeze`: from distances to those in the disc that an ellipse is made
// of.
inline void fill_axis(Axis* axis, double corner, int size, FloatPair center, FloatPair sigma,
                      float radius, double squeeze) {
  const double first = corner - in_full(center), reach = (double)radius;
  const double low = -first - reach, high = -first + reach;
  axis->first = low <= 0.0 ? 0 : low > (double)size ? size : (int)ceil(low);
  axis->last = high >= (double)(size - 1) ? size - 1 : high < 0.0 ? -1 : (int)high;
  if (axis->first > axis->last) return;
  const int begin = axis->first & ~7, end = (axis->last & ~7) + 8;
#ifdef SAMPLING_MEAN
  if (sigma.high < 1e4f) {
    fill_means(axis->shape, first, begin, end, in_full(sigma));
  } else
#endif
    fill_centers(axis->shape, first, begin, end, in_full(sigma));
  for (int k = begin; k < end; k += 8) {
    const double8 d = first + (double)k + ramp_of_eight();
    const double8 shape = vload8(0, axis->shape + k);
    vstore8(select(shape, (double8)(0.0), fabs(d) > reach), 0, axis->shape + k);
#ifdef KERNEL_CUT
    vstore8((d * squeeze) * (d * squeeze), 0, axis->square + k);
    vstore8((d > -0.5) & (d <= 0.5), 0, axis->holds + k);
#endif
  }
}

// Eight pixels of a row, zero outside the cut.
inline double8 cut_shape(double8 shape, const Axis* columns, int x, const Axis* rows, int y,
                         double cut_square) {
#ifdef KERNEL_CUT
  long8 inside = vload8(0, columns->square + x) + rows->square[y] <= cut_square;
#ifdef SAMPLING_MEAN
  inside |= vload8(0, columns->holds + x) & (long8)(rows->holds[y]);
#endif
  return select((double8)(0.0), shape, inside);
#else
  return shape;
#endif
}

#ifdef LIGHT_ORDERED
// phi(y) = (1 - exp(-y)) / y, by five terms of its series, whose error is y^5 / 720, or in full.
#define THIN_LAYER 0.03
inline double8 phi_of_thin(double8 y) {
  return 1.0 - y * (0.5 - y * (0.16666666666666666 -
                               y * (0.041666666666666664 - y * 0.0083333333333333332)));
}

// The layer behind what is already there.
inline void add_layer(double* pixel, double8 shape, const double* emission,
                      const double* absorption, int is_thin) {
  for (int c = 0; c < SUMS; ++c) {
    double* const source = pixel + c * TILE_PIXELS;
    double* const passing = pixel + (c + SUMS) * TILE_PIXELS;
    const double8 t = vload8(0, passing), depth = shape * absorption[c];
    double8 phi = phi_of_thin(depth), left = 1.0 - depth * phi;
    if (!is_thin) {
      const double8 passed = exp_of_minus(min(depth, (double8)(700.0)));
      const long8 is_thick = depth > THIN_LAYER;
      phi = select(phi, (1.0 - passed) / max(depth, (double8)(THIN_LAYER)), is_thick);
      left = select(left, passed, is_thick);
    }
    vstore8(vload8(0, source) + t * shape * phi * emission[c], 0, source);
    vstore8(t * left, 0, passing);
  }
}
#endif

inline void add_splat(double* tile, __global const ExtendedSplat* from, double corner_x,
                      double corner_y) {
  const ExtendedSplat splat = *from;
  Axis columns, rows;
#ifdef ELLIPSES
  const double squeeze = in_full(splat.sigma) / in_full(splat.along_x.sigma);
#else
  const double squeeze = 1.0;
#endif
  fill_axis(&columns, corner_x, TILE_WIDTH, splat.x, SIGMA_X(splat), RADIUS_X(splat), squeeze);
  if (columns.first > columns.last) return;
  fill_axis(&rows, corner_y, TILE_HEIGHT, splat.y, splat.sigma, splat.radius, 1.0);
  if (rows.first > rows.last) return;
  const double cut = in_full(splat.cut), cut_square = cut * cut;
  double summed[SUMS];
  for (int c = 0; c < SUMS; ++c)
    summed[c] = in_full(splat.summed[c]);
#ifdef LIGHT_ORDERED
  double emission[SUMS];
  for (int c = 0; c < SUMS; ++c)
    emission[c] = in_full(splat.emission[c]);
  // No mean is more than 1, and none more than the light below a pixel.
  const int is_thin = max(summed[0], max(summed[1], summed[2])) <= THIN_LAYER;
#endif
  for (int x = columns.first & ~7; x <= columns.last; x += 8) {
    const double8 across = vload8(0, columns.shape + x);
    for (int y = rows.first; y <= rows.last; ++y) {
      const double8 shape = cut_shape(across * rows.shape[y], &columns, x, &rows, y, cut_square);
      double* const pixel = tile + y * TILE_WIDTH + x;
#ifdef LIGHT_ORDERED
      add_layer(pixel, shape, emission, summed, is_thin);
#else
      for (int c = 0; c < SUMS; ++c) {
        double* const sum = pixel + c * TILE_PIXELS;
        vstore8(vload8(0, sum) + shape * summed[c], 0, sum);
      }
#endif
    }
  }
}

// Between the tile and pixels in memory, which hold depths.
inline void take_pixels(double* tile, const Pixels pixels) {
  for (int c = 0; c < SUMS; ++c) {
    vstore8(pixels.light[c], 0, tile + c * TILE_PIXELS);
#ifdef LIGHT_ORDERED
    vstore8(exp_of_minus(min(pixels.depth[c], (double8)(690.0))), 0,
            tile + (c + SUMS) * TILE_PIXELS);
#endif
  }
}

inline Pixels give_pixels(const double* tile) {
  Pixels pixels;
  for (int c = 0; c < SUMS; ++c) {
    pixels.light[c] = vload8(0, tile + c * TILE_PIXELS);
#ifdef LIGHT_ORDERED
    const double8 passing = vload8(0, tile + (c + SUMS) * TILE_PIXELS);
    pixels.depth[c] = -log(max(passing, (double8)(DARKEST)));
#endif
  }
  return pixels;
}

__kernel void composite(const CompositeParameters p, __global const Grid* grids,
                        __global const Segment* segments, __global const TileSplat* entries,
                        __global float* planes, __global float* partials,
                        __global const ExtendedSplat* splats) {
  const uint id = get_global_id(0);
  if (id >= p.end_segment) return;
  const Segment segment = segments[id];
  const Grid grid = grids[grid_of_tile(grids, p.grid_count, segment.tile)];
  const uint in_grid = segment.tile - grid.first_tile;
  const uint column = in_grid % (uint)grid.tiles_x, row = in_grid / (uint)grid.tiles_x;
  const double corner_x = (double)((uint)grid.first_x + column * TILE_WIDTH) + 0.5;
  const double corner_y = (double)((uint)grid.first_y + row * TILE_HEIGHT) + 0.5;
  const int is_part = segment.partial != NO_PARTIAL;
  __global float* part = partials + (is_part ? (size_t)segment.partial * PLANES * TILE_PIXELS : 0);
  double tile[TILE_PLANES * TILE_PIXELS];
  for (uint item = 0; item < GROUP; ++item) {
    const Pixels pixels =
        is_part ? no_pixels()
                : load_pixels(own_planes(planes, grid, segment.tile, item), grid.plane_size);
    take_pixels(tile + item * 8, pixels);
  }
  for (uint k = segment.begin; k < segment.end; ++k)
    add_splat(tile, splats + entries[k].slot, corner_x, corner_y);
  for (uint item = 0; item < GROUP; ++item) {
    const Pixels pixels = give_pixels(tile + item * 8);
    if (is_part) {
      store_pixels(pixels, part + item * 8, TILE_PIXELS);
    } else {
      store_pixels(pixels, own_planes(planes, grid, segment.tile, item), grid.plane_size);
    }
  }
}
