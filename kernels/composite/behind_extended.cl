// behind.cl in extended precision, eight pixels of a row at a time. Planes hold the two parts of
// light, then those of depths (extended_pixels.cl).
#define LANES_8
#include "kernels/common/common.cl"
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#include "kernels/composite/composite.h"
#include "kernels/extended/extended_lanes.cl"
#include "kernels/extended/precise.cl"

#pragma OPENCL FP_CONTRACT OFF

// As many as there are in the row.
static inline float8 load_first(int count, __global const float* pixels) {
  if (count >= 8) return vload8(0, pixels);
  float values[8] = {0, 0, 0, 0, 0, 0, 0, 0};
  for (int k = 0; k < count; ++k)
    values[k] = pixels[k];
  return vload8(0, values);
}

static inline ExtendedLanes load_first_extended(int count, __global const float* pixels,
                                                size_t plane) {
  return lanes_pair(load_first(count, pixels), load_first(count, pixels + plane));
}

static inline void store_first_extended(ExtendedLanes value, int count, __global float* pixels,
                                        size_t plane) {
  store_first(high_lanes(value), count, pixels);
  store_first(low_lanes(value), count, pixels + plane);
}

// Work-item (eight pixels of the crop, row). `layer` has the planes of a pixel one after the other,
// each p.width * p.height floats.
__kernel void put_behind(const BehindParameters p, __global const Grid* grids,
                         __global float* planes, __global const float* layer) {
  const int x = 8 * (int)get_global_id(0), y = (int)get_global_id(1);
  if (x >= p.width || y >= p.height) return;
  const int count = min(p.width - x, 8);
  const Grid grid = grids[0];
  __global float* own = planes + pixel_at(grid, 0, p.crop_x + x, p.crop_y + y);
  __global const float* behind = layer + (size_t)y * p.width + x;
  const size_t plane = grid.plane_size, layer_plane = (size_t)p.width * p.height;
  for (int c = 0; c < 3; ++c) {
    __global const float* added = behind + 2 * c * layer_plane;
    float8 high = load_first(count, added), low = load_first(count, added + layer_plane);
#if LIGHT_ORDERED
    __global float* depths = own + (2 * c + 6) * plane;
    const ExtendedLanes depth = load_first_extended(count, depths, plane);
    const float8 seen = precise_exp_negative(high_lanes(depth), low_lanes(depth));
    high *= seen;
    low *= seen;
    const ExtendedLanes deeper =
        load_first_extended(count, behind + (2 * c + 6) * layer_plane, layer_plane);
    store_first_extended(lanes_sum(depth, deeper), count, depths, plane);
#endif
    __global float* light = own + 2 * c * plane;
    const ExtendedLanes sum =
        lanes_sum(load_first_extended(count, light, plane), lanes_pair(high, low));
    store_first_extended(sum, count, light, plane);
  }
}
