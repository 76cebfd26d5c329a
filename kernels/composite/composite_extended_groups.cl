// Compositing in double precision for GPUs: a work-group takes a segment of one tile's list, a
// work-item eight pixels of a row. For a batch of splats at a time the group works out the shapes'
// columns and rows, and then every pixel takes their products.
#define LANES_8
#define PLANE 8
#include "kernels/bin/bin.h"
#include "kernels/common/common.cl"
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#include "kernels/composite/composite.h"
#include "kernels/composite/extended_layers.cl"
#include "kernels/composite/extended_pixels.cl"
#include "kernels/composite/extended_shape.cl"
#include "kernels/extended/extended_splat.h"

#pragma OPENCL FP_CONTRACT ON

#define BATCH 8

#if FACE_OF_CUBE
typedef struct Batch {
  ExtendedSplat splats[BATCH];
} Batch;

INLINED void fill_batch(__local Batch* batch, uint count, const ExtendedTile* of_tile) {}

// Whether the splat shows in the eight pixels from (x, y) on.
INLINED int find_shape(const __local Batch* batch, uint k, const ExtendedSplat* splat,
                       const ExtendedTile* of_tile, int x, int y, double8* shape) {
  ExtendedShape on_face;
  if (!start_shape(&on_face, splat, of_tile)) return 0;
  if (y < on_face.rows.first || y > on_face.rows.last) return 0;
  if (x + 7 < on_face.columns.first || x > on_face.columns.last) return 0;
  *shape = shape_of_eight(&on_face, shape_columns(&on_face, x), y);
  return 1;
}
#else
#define AXES (TILE_WIDTH + TILE_HEIGHT)
#define EIGHTS_OF_AXES (AXES / 8)

// Of each splat the shape's columns, then its rows.
typedef struct Batch {
  ExtendedSplat splats[BATCH];
  double shape[BATCH * AXES];
#if KERNEL_CUT
  double square[BATCH * AXES];
  long holds[BATCH * AXES];
#endif
} Batch;

INLINED void fill_batch(__local Batch* batch, uint count, const ExtendedTile* of_tile) {
  for (uint eight = get_local_id(0); eight < count * EIGHTS_OF_AXES; eight += GROUP) {
    const ExtendedSplat splat = batch->splats[eight / EIGHTS_OF_AXES];
    const int place = (int)(eight % EIGHTS_OF_AXES) * 8;
    Axis axis;
    if (place < TILE_WIDTH)
      fill_along_x(&axis, &splat, of_tile->corner_x + (double)place, 8);
    else
      fill_along_y(&axis, &splat, of_tile->corner_y + (double)(place - TILE_WIDTH), 8);
    const int is_empty = axis.range.first > axis.range.last;
    vstore8(is_empty ? (double8)(0.0) : vload8(0, axis.shape), eight, batch->shape);
#if KERNEL_CUT
    if (is_empty) continue;
    vstore8(vload8(0, axis.square), eight, batch->square);
    vstore8(vload8(0, axis.holds), eight, batch->holds);
#endif
  }
}

// Whether the splat shows in the eight pixels from (x, y) on.
INLINED int find_shape(const __local Batch* batch, uint k, const ExtendedSplat* splat,
                       const ExtendedTile* of_tile, int x, int y, double8* shape) {
  const int column = (int)k * AXES + x, in_row = (int)k * AXES + TILE_WIDTH + y;
  ShapeColumns columns;
  ShapeRow row;
  columns.shape = vload8(0, batch->shape + column);
  row.shape = batch->shape[in_row];
  if (row.shape == 0.0 || !any(columns.shape != 0.0)) return 0;
#if KERNEL_CUT
  columns.square = vload8(0, batch->square + column);
  columns.holds = vload8(0, batch->holds + column);
  row.square = batch->square[in_row];
  row.holds = batch->holds[in_row];
#endif
  const double cut = in_full(splat->cut);
  *shape = product_of(columns, row, cut * cut);
  return 1;
}
#endif

#define ADD_TO_EIGHT(ADD) ADD_EIGHT(ADD, pixels, shape, of)

INLINED void add_batch(double* pixels, const __local Batch* batch, uint count,
                       const ExtendedTile* of_tile) {
  const int item = (int)get_local_id(0);
  const int x = item * 8 % TILE_WIDTH, y = item * 8 / TILE_WIDTH;
  for (uint k = 0; k < count; ++k) {
    const ExtendedSplat splat = batch->splats[k];
    double8 shape;
    if (!find_shape(batch, k, &splat, of_tile, x, y, &shape)) continue;
    const Channels of = channels_of(&splat);
    WITH_FORMULA_FOR(of, ADD_TO_EIGHT)
  }
}

__kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void composite(
    const CompositeParameters p, __global const Grid* grids, __global const Segment* segments,
    __global const TileSplat* entries, __global float* planes, __global float* partials,
    __global const ExtendedSplat* extended_splats, __global const CloudEntry* clouds,
    __global const CloudSplat* cloud_splats, __global const float* directions,
    __global const DirectionCone* cones, __global const Stencil* stencils) {
  __local Batch batch;
  const uint item = get_local_id(0);
  const Segment segment = segments[p.first_segment + get_group_id(0)];
  const Grid grid = grids[grid_of_tile(grids, p.grid_count, segment.tile)];
  const ExtendedTile of_tile = extended_tile(segment.tile, grid, p.face);
  const int is_part = segment.partial != NO_PARTIAL;
  __global float* own = is_part
                            ? partials + (size_t)segment.partial * PLANES * TILE_PIXELS + item * 8
                            : own_planes(planes, grid, segment.tile, item);
  const size_t plane = is_part ? TILE_PIXELS : grid.plane_size;
  double8 eights[TILE_PLANES];
  double* const pixels = (double*)eights;
  take_pixels(pixels, is_part ? no_pixels() : load_pixels(own, plane));
  for (uint first = segment.begin; first < segment.end; first += BATCH) {
    const uint count = min((uint)BATCH, segment.end - first);
    if (item < count) batch.splats[item] = extended_splats[entries[first + item].slot];
    barrier(CLK_LOCAL_MEM_FENCE);
    fill_batch(&batch, count, &of_tile);
    barrier(CLK_LOCAL_MEM_FENCE);
    add_batch(pixels, &batch, count, &of_tile);
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  store_pixels(give_pixels(pixels), own, plane);
}
