// Where pixels, tiles and levels of grids are.
#include "kernels/common/common.cl"
#include "kernels/common/grid.h"

#pragma OPENCL FP_CONTRACT ON

static inline size_t first_float(const Grid grid) {
  return (size_t)grid.first_float_low | ((size_t)grid.first_float_high << 32);
}

// In extended precision a number is the sum of two floats, each in a plane of its own.
#define PLANES_OF_NUMBER (1 + EXTENDED_NUMBERS)

// Where a pixel of one of its planes is.
static inline size_t pixel_at(const Grid grid, uint plane, int x, int y) {
  return first_float(grid) + (size_t)plane * grid.plane_size +
         (size_t)(y - grid.first_y) * grid.stride + (size_t)(x - grid.first_x);
}

// Eight pixels of a row, or as many as there are.
static inline void store_first(float8 values, int count, __global float* pixels) {
  if (count >= 8) {
    vstore8(values, 0, pixels);
    return;
  }
  // As in resolve.cl.
  float lanes[8];
  vstore8(values, 0, lanes);
  for (int k = 0; k < 7; ++k) {
    if (k < count) pixels[k] = lanes[k];
  }
}

// The grid that a tile belongs to. Grids are few, coarse ones small.
static inline uint grid_of_tile(__global const Grid* grids, uint grid_count, uint tile) {
  uint g = 0;
  while (g + 1 < grid_count && tile >= grids[g + 1].first_tile)
    ++g;
  return g;
}

// Its pixels are 2^level of the picture's wide.
INLINED int level_of_grid(uint grid, const GridBlurs* blurs) {
  return grid == 0 ? 0 : (int)((grid - 1u) >> blurs->shift) + blurs->first_level;
}
INLINED float blur_of_grid(uint grid, const GridBlurs* blurs) {
  return grid == 0 ? 0.0f : blurs->sigma2[(grid - 1u) & (MOST_BLURS - 1u)];
}
