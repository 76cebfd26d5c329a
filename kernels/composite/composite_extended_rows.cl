// Compositing in double precision for processors with wide registers: as in composite_rows.cl a
// work-item takes a segment of one tile's list and updates rows of eight pixels in a private copy
// of the tile. In the ordered plan it holds transmittances: doubles of them lose no digits to
// layers, since each is multiplied by what the next layer lets through.
#define LANES_8
#include "kernels/bin/bin.h"
#include "kernels/common/common.cl"
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#include "kernels/common/pieces.cl"
#include "kernels/composite/composite.h"
#include "kernels/composite/extended_pixels.cl"
#include "kernels/composite/extended_shape.cl"
#include "kernels/extended/double_lanes.cl"
#include "kernels/extended/extended_splat.h"

#pragma OPENCL FP_CONTRACT ON

#define SUMS 3
#if LIGHT_ORDERED
#define TILE_PLANES 6
#else
#define TILE_PLANES 3
#endif
// Planes of whole pages would share lines of the cache.
#define PLANE (TILE_PIXELS + 8)
// Eight pixels of the tile, which begin at multiples of eight.
#define load_doubles(p) (*(const double8*)(p))
#define store_doubles(v, p) (*(double8*)(p) = (v))
#define DARKEST 1e-300  // of transmittances: their logarithm is a number

// What a splat adds to a channel at its center.
typedef struct Channel {
  double emission, summed;
} Channel;

#if LIGHT_ORDERED
// The splat's layer behind what is already there: with u = t X phi(A X) light grows by E u, and the
// transmittance t loses A u. Of layers of these depths and less phi(y) = (1 - exp(-y)) / y is taken
// by three terms of its series, whose error is y^3 / 24, and by five, whose error is y^5 / 720.
#define THINNEST_LAYER 1e-3
#define THIN_LAYER 0.03
INLINED double8 phi_of_thin(double8 y) {
  return 1.0 - y * (0.5 - y * (1.0 / 6 - y * (1.0 / 24 - y * (1.0 / 120))));
}

INLINED void add_thin(double* source, double8 covered, const Channel of) {
  double* const passing = source + SUMS * PLANE;
  const double8 t = load_doubles(passing), u = t * covered;
  store_doubles(load_doubles(source) + u * of.emission, source);
  store_doubles(t - u * of.summed, passing);
}

INLINED void add_thinnest_layer(double* source, double8 shape, const Channel of) {
  const double second = 0.5 * of.summed, third = of.summed * of.summed * (1.0 / 6);
  add_thin(source, shape - shape * shape * (second - shape * third), of);
}

INLINED void add_thin_layer(double* source, double8 shape, const Channel of) {
  add_thin(source, shape * phi_of_thin(shape * of.summed), of);
}

INLINED void add_layer(double* source, double8 shape, const Channel of) {
  double* const passing = source + SUMS * PLANE;
  const double8 t = load_doubles(passing), depth = shape * of.summed;
  const double8 series = phi_of_thin(depth), passed = exp_of_minus(min(depth, (double8)(700.0)));
  const long8 is_thick = depth > THIN_LAYER;
  const double8 phi = select(series, (1.0 - passed) / max(depth, (double8)(THIN_LAYER)), is_thick);
  store_doubles(load_doubles(source) + t * shape * phi * of.emission, source);
  store_doubles(t * select(1.0 - depth * series, passed, is_thick), passing);
}
#endif

INLINED void add_sum(double* sum, double8 shape, const Channel of) {
  store_doubles(load_doubles(sum) + shape * of.summed, sum);
}

// Written out for each channel, in values: what a loop took from an array it would fetch anew for
// every row.
#define ADD_ROWS(ADD)                                                         \
  for (int x = shapes.columns.first & ~7; x <= shapes.columns.last; x += 8) { \
    const ShapeColumns columns = shape_columns(&shapes, x);                   \
    for (int y = shapes.rows.first; y <= shapes.rows.last; ++y) {             \
      const double8 shape = shape_of_eight(&shapes, columns, y);              \
      double* const pixel = tile + y * TILE_WIDTH + x;                        \
      ADD(pixel, shape, red);                                                 \
      ADD(pixel + PLANE, shape, green);                                       \
      ADD(pixel + 2 * PLANE, shape, blue);                                    \
    }                                                                         \
  }

static inline void add_splat(double* tile, __global const ExtendedSplat* from,
                             const ExtendedTile* of_tile) {
  const ExtendedSplat splat = *from;
  ExtendedShape shapes;
  if (!start_shape(&shapes, &splat, of_tile)) return;
  const Channel red = {in_full(splat.emission[0]), in_full(splat.summed[0])};
  const Channel green = {in_full(splat.emission[1]), in_full(splat.summed[1])};
  const Channel blue = {in_full(splat.emission[2]), in_full(splat.summed[2])};
#if LIGHT_ORDERED
  // No mean is more than 1, and none more than the light below a pixel.
  const double deepest = max(red.summed, max(green.summed, blue.summed));
  if (deepest <= THINNEST_LAYER) {
    ADD_ROWS(add_thinnest_layer)
  } else if (deepest <= THIN_LAYER) {
    ADD_ROWS(add_thin_layer)
  } else {
    ADD_ROWS(add_layer)
  }
#else
  ADD_ROWS(add_sum)
#endif
}

// Between the tile and pixels in memory, which hold depths.
static inline void take_pixels(double* tile, const Pixels pixels) {
  for (int c = 0; c < SUMS; ++c) {
    store_doubles(pixels.light[c], tile + c * PLANE);
#if LIGHT_ORDERED
    store_doubles(exp_of_minus(min(pixels.depth[c], (double8)(690.0))), tile + (c + SUMS) * PLANE);
#endif
  }
}

static inline Pixels give_pixels(const double* tile) {
  Pixels pixels;
  for (int c = 0; c < SUMS; ++c) {
    pixels.light[c] = load_doubles(tile + c * PLANE);
#if LIGHT_ORDERED
    const double8 passing = load_doubles(tile + (c + SUMS) * PLANE);
    pixels.depth[c] = -log(max(passing, (double8)(DARKEST)));
#endif
  }
  return pixels;
}

KERNEL_BODY void composite_segment(const Segment segment, const CompositeParameters* of_frame,
                                   __global const Grid* grids, __global const TileSplat* entries,
                                   __global float* planes, __global float* partials,
                                   __global const ExtendedSplat* splats) {
  const CompositeParameters p = *of_frame;
  const Grid grid = grids[grid_of_tile(grids, p.grid_count, segment.tile)];
  const uint in_grid = segment.tile - grid.first_tile;
  const uint column = in_grid % (uint)grid.tiles_x, row = in_grid / (uint)grid.tiles_x;
  ExtendedTile of_tile;
  of_tile.corner_x = (double)((uint)grid.first_x + column * TILE_WIDTH) + 0.5;
  of_tile.corner_y = (double)((uint)grid.first_y + row * TILE_HEIGHT) + 0.5;
  of_tile.face = p.face;
  const int is_part = segment.partial != NO_PARTIAL;
  __global float* part = partials + (is_part ? (size_t)segment.partial * PLANES * TILE_PIXELS : 0);
  double8 eights[TILE_PLANES * PLANE / 8];
  double* const tile = (double*)eights;
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

__kernel void composite(const CompositeParameters p, __global const Grid* grids,
                        __global const Segment* segments, __global const TileSplat* entries,
                        __global float* planes, __global float* partials,
                        __global const ExtendedSplat* extended_splats,
                        __global const CloudEntry* clouds, __global const CloudSplat* cloud_splats,
                        __global const float* directions, __global const DirectionCone* cones,
                        __global const Stencil* stencils) {
  const uint piece = piece_of_item(p.end_segment - p.first_segment);
  if (piece == NO_PIECE) return;
  composite_segment(segments[p.first_segment + piece], &p, grids, entries, planes, partials,
                    extended_splats);
}
