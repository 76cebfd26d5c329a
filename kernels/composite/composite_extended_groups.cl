// Compositing in double precision for GPUs: a work-group takes a segment of one tile's list, a
// work-item eight pixels of a row. For a batch of splats at a time the group works out the shapes'
// columns and rows, and then every pixel takes their products.
#define LANES_8
#define PLANE 8
#include "kernels/bin/bin.h"
#include "kernels/common/common.cl"
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#include "kernels/common/splat.h"
#include "kernels/composite/composite.h"
#include "kernels/composite/extended_layers.cl"
#include "kernels/composite/extended_shape.cl"

#pragma OPENCL FP_CONTRACT ON

#define BATCH 8
#define AXES (TILE_WIDTH + TILE_HEIGHT)
#define EIGHTS_OF_AXES (AXES / 8)

// Of each splat the shape's columns, then its rows.
typedef struct Batch {
  Splat splats[BATCH];
  double shape[BATCH * AXES];
} Batch;

INLINED void fill_batch(__local Batch* batch, uint count, const ExtendedTile* of_tile) {
  for (uint eight = get_local_id(0); eight < count * EIGHTS_OF_AXES; eight += GROUP) {
    const Splat splat = batch->splats[eight / EIGHTS_OF_AXES];
    const int place = (int)(eight % EIGHTS_OF_AXES) * 8;
    Axis axis;
    if (place < TILE_WIDTH)
      fill_along_x(&axis, &splat, of_tile->corner_x + (double)place, 8);
    else
      fill_along_y(&axis, &splat, of_tile->corner_y + (double)(place - TILE_WIDTH), 8);
    vstore8(is_empty(&axis) ? (double8)(0.0) : vload8(0, axis.shape), eight, batch->shape);
  }
}

#define ADD_TO_EIGHT(ADD) ADD_EIGHT(ADD, pixels, shape, of)

INLINED void add_batch(double* pixels, const __local Batch* batch, uint count,
                       const ExtendedTile* of_tile) {
  const int item = (int)get_local_id(0);
  const int x = item * 8 % TILE_WIDTH, y = item * 8 / TILE_WIDTH;
  for (uint k = 0; k < count; ++k) {
    const double8 product =
        vload8(0, batch->shape + k * AXES + x) * batch->shape[k * AXES + TILE_WIDTH + y];
    if (!any(product != 0.0)) continue;
    const ExtendedSplat splat = batch->splats[k].extended;
    const double8 shape = shape_of_eight(&splat, of_tile, product, x, y);
    const Channels of = channels_of(&splat);
    WITH_FORMULA_FOR(of, ADD_TO_EIGHT)
  }
}

__kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void composite(COMPOSITE_PARAMETERS) {
  __local Batch batch;
  const uint item = get_local_id(0);
  const Segment segment = segments[p.first_segment + get_group_id(0)];
  const Grid grid = grids[grid_of_tile(grids, p.grid_count, segment.tile)];
  const ExtendedTile of_tile = extended_tile(segment.tile, grid, p.face);
  size_t plane;
  __global float* own = own_pixels(segment, grid, planes, partials, item, &plane);
  double8 eights[NUMBERS];
  double* const pixels = (double*)eights;
  take_pixels(pixels, own, plane, segment.partial != NO_PARTIAL);
  for (uint first = segment.begin; first < segment.end; first += BATCH) {
    const uint count = min((uint)BATCH, segment.end - first);
    if (item < count)
      batch.splats[item] = ((__global const Splat*)splats)[entries[first + item].slot];
    barrier(CLK_LOCAL_MEM_FENCE);
    fill_batch(&batch, count, &of_tile);
    barrier(CLK_LOCAL_MEM_FENCE);
    add_batch(pixels, &batch, count, &of_tile);
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  give_pixels(pixels, own, plane);
}
