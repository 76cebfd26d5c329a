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

inline void add_splat(double* tile, __global const ExtendedSplat* from,
                      const ExtendedTile* of_tile) {
  const ExtendedSplat splat = *from;
  ExtendedShape shapes;
  if (!start_shape(&shapes, &splat, of_tile)) return;
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
  for (int x = shapes.columns.first & ~7; x <= shapes.columns.last; x += 8) {
    for (int y = shapes.rows.first; y <= shapes.rows.last; ++y) {
      const double8 shape = shape_of_eight(&shapes, x, y);
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
  ExtendedTile of_tile;
  of_tile.corner_x = (double)((uint)grid.first_x + column * TILE_WIDTH) + 0.5;
  of_tile.corner_y = (double)((uint)grid.first_y + row * TILE_HEIGHT) + 0.5;
  of_tile.face = p.face;
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
    add_splat(tile, splats + entries[k].slot, &of_tile);
  for (uint item = 0; item < GROUP; ++item) {
    const Pixels pixels = give_pixels(tile + item * 8);
    if (is_part) {
      store_pixels(pixels, part + item * 8, TILE_PIXELS);
    } else {
      store_pixels(pixels, own_planes(planes, grid, segment.tile, item), grid.plane_size);
    }
  }
}
