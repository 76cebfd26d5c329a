// Pixels of extended precision in the planes, eight of a row at a time, and how the layers of a
// tile's segments are joined.
#include "kernels/bin/bin.h"
#include "kernels/common/common.cl"
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#include "kernels/composite/composite.h"
#include "kernels/extended/double_lanes.cl"

#pragma OPENCL FP_CONTRACT ON

#define TILE_PIXELS (TILE_WIDTH * TILE_HEIGHT)
#define GROUP (TILE_PIXELS / 8)

// Planes hold, of each channel, the source's (or the sum's) high and low part, then those of
// the depth.
typedef struct Pixels {
  double8 light[3];
#if LIGHT_ORDERED
  double8 depth[3];
#endif
} Pixels;

static inline double8 load_extended(__global const float* planes, size_t plane) {
  return sum_of_parts(vload8(0, planes), vload8(0, planes + plane));
}
static inline void store_extended(double8 value, __global float* planes, size_t plane) {
  vstore8(convert_float8(value), 0, planes);
  vstore8(low_part(value), 0, planes + plane);
}
static inline Pixels load_pixels(__global const float* planes, size_t plane) {
  Pixels pixels;
  for (int c = 0; c < 3; ++c) {
    pixels.light[c] = load_extended(planes + 2 * c * plane, plane);
#if LIGHT_ORDERED
    pixels.depth[c] = load_extended(planes + (2 * c + 6) * plane, plane);
#endif
  }
  return pixels;
}
static inline void store_pixels(const Pixels pixels, __global float* planes, size_t plane) {
  for (int c = 0; c < 3; ++c) {
    store_extended(pixels.light[c], planes + 2 * c * plane, plane);
#if LIGHT_ORDERED
    store_extended(pixels.depth[c], planes + (2 * c + 6) * plane, plane);
#endif
  }
}
static inline Pixels no_pixels() {
  Pixels pixels;
  for (int c = 0; c < 3; ++c) {
    pixels.light[c] = (double8)(0.0);
#if LIGHT_ORDERED
    pixels.depth[c] = pixels.light[c];
#endif
  }
  return pixels;
}

static inline double8 transmittance(double8 depth) {
  return exp_of_minus(min(depth, (double8)(700.0)));
}

// Where the work-item's pixels lie in the planes of their grid.
static inline __global float* own_planes(__global float* planes, const Grid grid, uint tile,
                                         uint item) {
  const uint in_grid = tile - grid.first_tile;
  const uint row = in_grid / (uint)grid.tiles_x * TILE_HEIGHT + item * 8 / TILE_WIDTH;
  const uint column = in_grid % (uint)grid.tiles_x * TILE_WIDTH + item * 8 % TILE_WIDTH;
  return planes + first_float(grid) + (size_t)row * grid.stride + column;
}

// Joins the layers of a tile that was cut into segments, nearest first, into the planes: a
// work-group per segment, of which the first of a tile joins them all.
__kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void join_extended(
    const CompositeParameters p, __global const Grid* grids, __global const Segment* segments,
    __global float* planes, __global const float* partials) {
  const uint id = get_group_id(0), item = get_local_id(0);
  const Segment first = segments[id];
  if (first.partial == NO_PARTIAL || (id > 0 && segments[id - 1].tile == first.tile)) return;
  const Grid grid = grids[grid_of_tile(grids, p.grid_count, first.tile)];
  __global float* own = own_planes(planes, grid, first.tile, item);
  Pixels pixels = load_pixels(own, grid.plane_size);
  for (uint s = id; s < p.end_segment && segments[s].tile == first.tile; ++s) {
    const Pixels behind = load_pixels(
        partials + (size_t)segments[s].partial * PLANES * TILE_PIXELS + item * 8, TILE_PIXELS);
    for (int c = 0; c < 3; ++c) {
#if LIGHT_ORDERED
      pixels.light[c] += behind.light[c] * transmittance(pixels.depth[c]);
      pixels.depth[c] += behind.depth[c];
#else
      pixels.light[c] += behind.light[c];
#endif
    }
  }
  store_pixels(pixels, own, grid.plane_size);
}
