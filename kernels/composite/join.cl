// Joins the layers of a tile that was cut into segments, nearest first, into the planes.
// Work-item (row of the tile, segment): those of the first segment of a cut tile join them all.
#include "kernels/bin/bin.h"
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#include "kernels/common/lanes.cl"
#include "kernels/composite/composite.h"
#include "kernels/composite/planes.cl"

__kernel void join(const CompositeParameters p, __global const Grid* grids,
                   __global const Segment* segments, __global float* planes,
                   __global const float* partials) {
  const uint id = p.first_segment + get_global_id(1), row = get_global_id(0);
  if (id >= p.end_segment) return;
  const Segment first = segments[id];
  if (first.partial == NO_PARTIAL || (id > 0 && segments[id - 1].tile == first.tile)) return;
  const Grid grid = grids[grid_of_tile(grids, p.grid_count, first.tile)];
  __global float* own = planes + first_of_tile(grid, first.tile) + (size_t)row * grid.stride;
  const size_t layer_plane = TILE_WIDTH * TILE_HEIGHT;
  for (uint x = 0; x < TILE_WIDTH; x += LANES) {
    VALUE front[NUMBERS], layer[NUMBERS];
    load_numbers(own + x, grid.plane_size, front);
    for (uint s = id; s < p.end_segment && segments[s].tile == first.tile; ++s) {
      const size_t partial = (size_t)segments[s].partial * PLANES * layer_plane;
      load_numbers(partials + partial + (size_t)row * TILE_WIDTH + x, layer_plane, layer);
      add_behind(front, layer);
    }
    store_numbers(front, own + x, grid.plane_size);
  }
}
