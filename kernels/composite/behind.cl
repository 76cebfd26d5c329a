// A layer that was worked out pixel by pixel, put behind what the planes of the picture's own grid
// hold: of clouds around the camera, which are no splats. In sums it is added.
#undef LANES_8  // one pixel after the other
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#include "kernels/common/lanes.cl"
#include "kernels/composite/composite.h"
#include "kernels/composite/planes.cl"

// Work-item (some pixels of the crop side by side, row): what a pixel takes is so little that an
// item of its own would take longer. `layer` has the planes of a pixel one after the other, each
// p.width * p.height floats.
__kernel void put_behind(const BehindParameters p, __global const Grid* grids,
                         __global float* planes, __global const float* layer) {
  const int x = (int)get_global_id(0) * PIXELS_BEHIND, y = (int)get_global_id(1);
  if (x >= p.width || y >= p.height) return;
  const int count = min(PIXELS_BEHIND, p.width - x);
  __global const Grid* grid = grids;
  __global float* own = planes + pixel_at(*grid, 0, p.crop_x + x, p.crop_y + y);
  __global const float* behind = layer + (size_t)y * p.width + x;
  const size_t plane = grid->plane_size, layer_plane = (size_t)p.width * p.height;
  // Pixels are independent: a compiler makes vectors of them, or need not say that it cannot.
#pragma clang diagnostic ignored "-Wpass-failed"
#pragma clang loop vectorize(assume_safety)
  for (int i = 0; i < count; ++i) {
    VALUE front[NUMBERS], layer_here[NUMBERS];
    load_numbers(own + i, plane, front);
    load_numbers(behind + i, layer_plane, layer_here);
    add_behind(front, layer_here);
    store_numbers(front, own + i, plane);
  }
}
