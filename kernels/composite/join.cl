// Joins the layers of a tile that was cut into segments, nearest first, into the planes.
// Work-item (row of the tile, segment): those of the first segment of a cut tile join them all.
#include "kernels/bin/bin.h"
#include "kernels/common/common.cl"
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#include "kernels/common/lanes.cl"
#include "kernels/composite/composite.h"
#include "kernels/composite/opacity.cl"

// LANES pixels of a layer behind the planes' one.
static inline void join_pixels(__global float* planes, size_t plane, __global const float* partial,
                               size_t pixel) {
#if LIGHT_ORDERED
  for (int c = 0; c < 3; ++c) {
    __global float* source = planes + (size_t)c * plane;
    __global float* opacity = planes + (size_t)(c + 3) * plane;
    const VALUE before = LOAD(opacity), transmittance = transmittance_of(before);
    const VALUE behind = LOAD(partial + (size_t)(c + 3) * TILE_WIDTH * TILE_HEIGHT + pixel);
    const VALUE light = LOAD(partial + (size_t)c * TILE_WIDTH * TILE_HEIGHT + pixel);
    STORE(LOAD(source) + transmittance * light, source);
    STORE(carry_behind(before, transmittance, behind), opacity);
  }
#else
  for (int c = 0; c < PLANES; ++c) {
    __global float* light = planes + (size_t)c * plane;
    STORE(LOAD(light) + LOAD(partial + (size_t)c * TILE_WIDTH * TILE_HEIGHT + pixel), light);
  }
#endif
}

__kernel void join(const CompositeParameters p, __global const Grid* grids,
                   __global const Segment* segments, __global float* planes,
                   __global const float* partials) {
  const uint id = p.first_segment + get_global_id(1);
  const uint row = get_global_id(0);
  if (id >= p.end_segment) return;
  const Segment first = segments[id];
  if (first.partial == NO_PARTIAL || (id > 0 && segments[id - 1].tile == first.tile)) return;
  const Grid grid = grids[grid_of_tile(grids, p.grid_count, first.tile)];
  const uint in_grid = first.tile - grid.first_tile;
  __global float* corner =
      planes + first_float(grid) +
      ((size_t)(in_grid / (uint)grid.tiles_x) * TILE_HEIGHT + row) * grid.stride +
      (size_t)(in_grid % (uint)grid.tiles_x) * TILE_WIDTH;
  for (uint s = id; s < p.end_segment && segments[s].tile == first.tile; ++s) {
    __global const float* partial =
        partials + (size_t)segments[s].partial * PLANES * TILE_WIDTH * TILE_HEIGHT;
    for (uint x = 0; x < TILE_WIDTH; x += LANES)
      join_pixels(corner + x, grid.plane_size, partial, (size_t)row * TILE_WIDTH + x);
  }
}
