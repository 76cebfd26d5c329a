// Compositing in double precision for processors with wide registers: as in composite_rows.cl a
// work-item takes a segment of one tile's list and updates rows of eight pixels in a private copy
// of the tile.
#define LANES_8
// Planes of whole pages would share lines of the cache.
#define PLANE (TILE_PIXELS + 8)
#include "kernels/bin/bin.h"
#include "kernels/common/common.cl"
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#include "kernels/common/splat.h"
#include "kernels/composite/composite.h"
#include "kernels/composite/extended_layers.cl"
#include "kernels/composite/extended_shape.cl"

#pragma OPENCL FP_CONTRACT ON

#define ADD_ROWS(ADD)                                                                \
  for (int x = along_x.first & ~7; x <= along_x.last; x += 8) {                      \
    const double8 column = vload8(0, along_x.shape + x);                             \
    for (int y = along_y.first; y <= along_y.last; ++y) {                            \
      const double8 product = column * along_y.shape[y];                             \
      const double8 shape = shape_of_eight(&splat.extended, of_tile, product, x, y); \
      ADD_EIGHT(ADD, tile + y * TILE_WIDTH + x, shape, of);                          \
    }                                                                                \
  }

static inline void add_splat(double* tile, __global const Splat* from,
                             const ExtendedTile* of_tile) {
  const Splat splat = *from;
  Axis along_x, along_y;
  fill_along_x(&along_x, &splat, of_tile->corner_x, TILE_WIDTH);
  if (is_empty(&along_x)) return;
  fill_along_y(&along_y, &splat, of_tile->corner_y, TILE_HEIGHT);
  if (is_empty(&along_y)) return;
  const Channels of = channels_of(&splat.extended);
  WITH_FORMULA_FOR(of, ADD_ROWS)
}

KERNEL_BODY void composite_segment(const Segment segment, const CompositeParameters* of_frame,
                                   __global const Grid* grids, __global const TileSplat* entries,
                                   __global float* planes, __global float* partials,
                                   __global const Splat* splats) {
  const CompositeParameters p = *of_frame;
  const Grid grid = grids[grid_of_tile(grids, p.grid_count, segment.tile)];
  const ExtendedTile of_tile = extended_tile(segment.tile, grid, p.face);
  double8 eights[NUMBERS * PLANE / 8];
  double* const tile = (double*)eights;
  size_t plane;
  for (uint item = 0; item < GROUP; ++item) {
    __global float* own = own_pixels(segment, grid, planes, partials, item, &plane);
    take_pixels(tile + item * 8, own, plane, segment.partial != NO_PARTIAL);
  }
  for (uint k = segment.begin; k < segment.end; ++k)
    add_splat(tile, splats + entries[k].slot, &of_tile);
  for (uint item = 0; item < GROUP; ++item) {
    __global float* own = own_pixels(segment, grid, planes, partials, item, &plane);
    give_pixels(tile + item * 8, own, plane);
  }
}

__kernel void composite(COMPOSITE_PARAMETERS) {
  const uint piece = piece_of_item(p.end_segment - p.first_segment);
  if (piece == NO_PIECE) return;
  composite_segment(segments[p.first_segment + piece], &p, grids, entries, planes, partials,
                    (__global const Splat*)splats);
}
