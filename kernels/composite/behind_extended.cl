// behind.cl in extended precision, eight pixels of a row at a time. Planes hold the two parts of
// light, then those of depths (extended_pixels.cl).
#define LANES_8
#include "kernels/common/common.cl"
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#include "kernels/composite/composite.h"
#include "kernels/extended/double_lanes.cl"

#pragma OPENCL FP_CONTRACT ON

// As many as there are in the row.
static inline float8 load_first(int count, __global const float* pixels) {
  if (count >= 8) return vload8(0, pixels);
  float values[8] = {0, 0, 0, 0, 0, 0, 0, 0};
  for (int k = 0; k < count; ++k)
    values[k] = pixels[k];
  return vload8(0, values);
}

static inline double8 load_first_extended(int count, __global const float* pixels, size_t plane) {
  return sum_of_parts(load_first(count, pixels), load_first(count, pixels + plane));
}

static inline void store_first_extended(double8 value, int count, __global float* pixels,
                                        size_t plane) {
  store_first(convert_float8(value), count, pixels);
  store_first(low_part(value), count, pixels + plane);
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
    double8 added = load_first_extended(count, behind + 2 * c * layer_plane, layer_plane);
#if LIGHT_ORDERED
    __global float* depths = own + (2 * c + 6) * plane;
    const double8 depth = load_first_extended(count, depths, plane);
    added *= exp_of_minus(min(depth, (double8)(700.0)));
    const double8 deeper =
        load_first_extended(count, behind + (2 * c + 6) * layer_plane, layer_plane);
    store_first_extended(depth + deeper, count, depths, plane);
#endif
    __global float* light = own + 2 * c * plane;
    store_first_extended(load_first_extended(count, light, plane) + added, count, light, plane);
  }
}
