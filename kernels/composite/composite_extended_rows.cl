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
#include "kernels/common/pieces.cl"
#include "kernels/composite/composite.h"
#include "kernels/composite/extended_layers.cl"
#include "kernels/composite/extended_pixels.cl"
#include "kernels/composite/extended_shape.cl"
#include "kernels/extended/extended_splat.h"

#pragma OPENCL FP_CONTRACT ON

#define ADD_ROWS(ADD)                                                         \
  for (int x = shapes.columns.first & ~7; x <= shapes.columns.last; x += 8) { \
    const ShapeColumns columns = shape_columns(&shapes, x);                   \
    for (int y = shapes.rows.first; y <= shapes.rows.last; ++y) {             \
      const double8 shape = shape_of_eight(&shapes, columns, y);              \
      ADD_EIGHT(ADD, tile + y * TILE_WIDTH + x, shape, of);                   \
    }                                                                         \
  }

static inline void add_splat(double* tile, __global const ExtendedSplat* from,
                             const ExtendedTile* of_tile) {
  const ExtendedSplat splat = *from;
  ExtendedShape shapes;
  if (!start_shape(&shapes, &splat, of_tile)) return;
  const Channels of = channels_of(&splat);
  WITH_FORMULA_FOR(of, ADD_ROWS)
}

KERNEL_BODY void composite_segment(const Segment segment, const CompositeParameters* of_frame,
                                   __global const Grid* grids, __global const TileSplat* entries,
                                   __global float* planes, __global float* partials,
                                   __global const ExtendedSplat* splats) {
  const CompositeParameters p = *of_frame;
  const Grid grid = grids[grid_of_tile(grids, p.grid_count, segment.tile)];
  const ExtendedTile of_tile = extended_tile(segment.tile, grid, p.face);
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
