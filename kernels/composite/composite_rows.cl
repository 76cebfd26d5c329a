// Compositing for processors with wide registers: a work-item takes a segment of one
// tile's list and updates rows of eight pixels in a private copy of the tile.
#include "kernels/common/common.cl"
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#if ROWS_OF_16
#include "kernels/common/lanes_of_16.cl"
#endif
#include "kernels/bin/bin.h"
#include "kernels/composite/clouds.cl"
#include "kernels/composite/composite.h"
#include "kernels/composite/ordered_list.cl"
#include "kernels/composite/patch.cl"
#include "kernels/composite/planes.cl"
#include "kernels/composite/rows.cl"
#include "kernels/composite/stencil.cl"
#include "kernels/composite/summed_list.cl"
#include "kernels/composite/tile_planes.cl"

// A call: of a kernel itself PoCL makes three copies. Its last argument tells the compiler that it
// may use registers of sixteen floats (lanes.cl).
__attribute__((noinline)) static void composite_segment(
    const Segment segment, const CompositeParameters* p, __global const Grid* grids,
    __global const TileSplat* entries, __global float* planes, __global float* partials,
    const CloudTables* clouds, __global const Stencil* stencils, PATCH lanes) {
  const CompositeParameters parameters = *p;
  const uint number = grid_of_tile(grids, parameters.grid_count, segment.tile);
  const TileInPlanes place = tile_in_planes(planes, grids[number], segment.tile);
  float memory_of_tile[BEFORE_TILE + PLANES * TILE_PIXELS] __attribute__((aligned(64)));
  float* const tile = memory_of_tile + BEFORE_TILE;
  clear_planes(tile);
  draw_list(tile, segment, &place, grids + number, number, entries, partials, &parameters, clouds,
            stencils, lanes);
}

__kernel void composite(COMPOSITE_PARAMETERS) {
  const uint piece = piece_of_item(p.end_segment - p.first_segment);
  if (piece == NO_PIECE) return;
  const CloudTables tables = {clouds, cloud_splats, directions, cones};
  composite_segment(segments[p.first_segment + piece], &p, grids, entries, planes, partials,
                    &tables, stencils, PATCH_LANES);
}
