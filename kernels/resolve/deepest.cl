// How deep a picture's layers are at most, by how much shows through them, or by 1 less their depth
// where planes hold sums: in eight columns of a row of blocks, which are as high as those of the
// check (frame_check.h, BlockErrors).
#define LANES_8
#include "kernels/common/common.cl"
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#include "kernels/common/lanes.cl"
#include "kernels/composite/opacity.cl"
#include "kernels/resolve/resolve.h"

// Work-item (eight columns, row of blocks).
__kernel void find_deepest(const ResolveParameters p, __global const Grid* grids,
                           __global const float* planes, __global float* deepest) {
  const Grid grid = grids[0];
  const int x = 8 * (int)get_global_id(0), top = ROWS_OF_BLOCK * (int)get_global_id(1);
  if (x >= p.width) return;
  float8 least = (float8)(1.0f);
  for (int y = top; y < min(top + ROWS_OF_BLOCK, p.height); ++y) {
    for (uint c = 0; c < 3; ++c) {
      const uint plane = (c + 3 * LIGHT_ORDERED) * PLANES_OF_NUMBER;
      least = min(least, transmittance_of(vload8(
                             0, planes + pixel_at(grid, plane, p.crop_x + x, p.crop_y + y))));
    }
  }
  float columns[8], of_all = 1.0f;
  vstore8(least, 0, columns);
  for (int i = 0; i < min(p.width - x, 8); ++i)
    of_all = min(of_all, columns[i]);
  deepest[get_global_id(1) * ((size_t)(p.width + 7) / 8) + get_global_id(0)] = of_all;
}
