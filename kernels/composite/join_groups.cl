// Joins the layers of a tile that was cut into segments, as join.cl does, for GPUs: work-groups of
// a segment, of which those of a tile's first one join them all, a work-item per pixel.
#include "kernels/bin/bin.h"
#include "kernels/common/common.cl"
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#include "kernels/common/group_sums.cl"
#include "kernels/common/lanes.cl"
#include "kernels/composite/composite.h"
#include "kernels/composite/planes.cl"

#define TILE_PIXELS (TILE_WIDTH * TILE_HEIGHT)
#define GROUPS_OF_TILE (TILE_PIXELS / GROUP_ITEMS)

// The segment behind the tile's last one. All items look for it together: to read one segment after
// the other would take longer than to join them.
INLINED uint end_of_tile(__local uint* end, __global const Segment* segments, uint first,
                         uint end_segment) {
  const uint tile = segments[first].tile;
  uint searched = first + 1, found = end_segment;
  if (get_local_id(0) == 0) *end = end_segment;
  barrier(CLK_LOCAL_MEM_FENCE);
  while (searched < found) {
    const uint s = searched + get_local_id(0);
    if (s < end_segment && segments[s].tile != tile) atomic_min(end, s);
    searched += GROUP_ITEMS;
    barrier(CLK_LOCAL_MEM_FENCE);
    found = *end;
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  return found;
}

__kernel OF_GROUPS void join(const CompositeParameters p, __global const Grid* grids,
                             __global const Segment* segments, __global float* planes,
                             __global const float* partials) {
  __local uint end;
  const uint id = p.first_segment + get_group_id(0) / GROUPS_OF_TILE;
  const uint pixel = get_group_id(0) % GROUPS_OF_TILE * GROUP_ITEMS + get_local_id(0);
  const Segment first = segments[id];
  const int joins = first.partial != NO_PARTIAL && (id == 0 || segments[id - 1].tile != first.tile);
  const uint count =
      end_of_tile(&end, segments, id, joins ? p.end_segment : min(id + 1, p.end_segment)) - id;
  if (!joins) return;
  const Grid grid = grids[grid_of_tile(grids, p.grid_count, first.tile)];
  __global float* own = planes + first_of_tile(grid, first.tile) +
                        (size_t)(pixel / TILE_WIDTH) * grid.stride + pixel % TILE_WIDTH;
  // Kept where no store can change it, so that layers are read before they are wanted.
  VALUE front[NUMBERS];
  load_numbers(own, grid.plane_size, front);
  __global const float* layers = partials + (size_t)first.partial * PLANES * TILE_PIXELS + pixel;
#pragma unroll 4
  for (uint k = 0; k < count; ++k) {
    VALUE behind[NUMBERS];
    load_numbers(layers + (size_t)k * PLANES * TILE_PIXELS, TILE_PIXELS, behind);
    add_behind(front, behind);
  }
  store_numbers(front, own, grid.plane_size);
}
