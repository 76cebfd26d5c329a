// Formulas that several stages share. The host puts a block of #defines in front of each program
// (src/device/frame/specialization.cpp).
#include "kernels/common/splat.h"

#pragma OPENCL FP_CONTRACT ON

// Where a call would cost: PoCL leaves functions of some length as calls, and their structures
// in memory.
#ifndef INLINED  // scripts/test_icd has another for a simulator
#define INLINED __attribute__((always_inline)) static inline
#endif

// What hardly any lane needs: a call on processors, where it would take registers from what all of
// them need. GPUs' compilers would put the structures that a call is handed in memory of each
// work-item's own, and keep registers for it.
#ifdef LANES_8
#define SELDOM_CALLED __attribute__((noinline)) static
#else
#define SELDOM_CALLED INLINED
#endif

// What a kernel does for a work-item, whose numbers it is handed. Of a kernel PoCL makes three
// copies for processors, and puts into them whatever asks for such a number itself: with a call in
// it, it is compiled in half the time. Elsewhere a call would cost.
#ifdef CALLS_BODIES
#define KERNEL_BODY __attribute__((noinline)) static
#else
#define KERNEL_BODY INLINED
#endif

// Of functions that there are for eight numbers and for sixteen.
#ifdef ROWS_OF_16
#define OVERLOADED __attribute__((overloadable))
#else
#define OVERLOADED
#endif

#ifdef ELLIPSES
#define SIGMA_X(splat) ((splat).along_x.sigma)
#define RADIUS_X(splat) ((splat).along_x.radius)
#else
#define SIGMA_X(splat) ((splat).sigma)
#define RADIUS_X(splat) ((splat).radius)
#endif

static inline size_t first_float(const Grid grid) {
  return (size_t)grid.first_float_low | ((size_t)grid.first_float_high << 32);
}

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

INLINED uint component_of(const Splat splat) {
  return splat.component_and_grid & 0xffffu;
}
INLINED uint grid_of(const Splat splat) {
  return (splat.component_and_grid >> 16) & 0xffu;
}
// Its pixels are 2^level of the picture's wide.
INLINED int level_of_grid(uint grid, const GridBlurs* blurs) {
  return grid == 0 ? 0 : (int)((grid - 1u) >> blurs->shift) + blurs->first_level;
}
INLINED float blur_of_grid(uint grid, const GridBlurs* blurs) {
  return grid == 0 ? 0.0f : blurs->sigma2[(grid - 1u) & (MOST_BLURS - 1u)];
}
// The power of two by which its units are coarser than its grid's.
INLINED uint coarser_of(const Splat splat) {
  return splat.component_and_grid >> 24;
}
// The splat's units are 2^-place_bits pixels.
INLINED int place_bits_of(const Splat splat, const Grid grid) {
  return grid.place_bits - (int)coarser_of(splat);
}

// In pixels of the grid: a power of two.
INLINED float unit_of(const Splat splat, const Grid grid) {
  return as_float(as_uint(grid.unit) + (coarser_of(splat) << 23));
}

#ifdef FINE_PLACES
INLINED float fraction_of_x(const Splat splat) {
  return (float)((int)(splat.place_fractions << 16) >> 16) * 0x1p-16f;
}
INLINED float fraction_of_y(const Splat splat) {
  return (float)((int)splat.place_fractions >> 16) * 0x1p-16f;
}

// What a float of so many units does not hold of them, and the fraction of a unit.
INLINED float rest_of_units(int units, float fraction, float unit) {
  return ((float)(units - convert_int_sat((float)units)) + fraction) * unit;
}
#endif

// First and last pixel whose center (index + first_center) lies within `radius` of `center`,
// clamped to [0, size - 1]; first > last where there is none. Clamped before the
// conversion: a splat close to the camera may lie anywhere.
INLINED int2 pixel_range(float center, float radius, float first_center, int size) {
  const float low = center - radius - first_center, high = center + radius - first_center;
  const float end = (float)size;
  const float first = low > 0.0f ? (low < end ? low : end) : 0.0f;
  const float last = high < end - 1.0f ? (high > -1.0f ? high : -1.0f) : end - 1.0f;
  // Up and down by comparison: ceil and floor are calls on PoCL.
  const int2 truncated = (int2)((int)first, (int)last);
  return (int2)(truncated.x + ((float)truncated.x < first),
                truncated.y - ((float)truncated.y > last));
}

// The radius of a cut disc: the drawn one, less the half pixel of pixel means.
static inline float cut_radius(float radius) {
#ifdef SAMPLING_MEAN
  return radius - 0.5f;
#else
  return radius;
#endif
}
