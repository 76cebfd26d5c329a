// The numbers of pixels in planes, on VALUEs (lanes.cl, extended_layers.cl): of each channel a
// source or sum, and in order an opacity (opacity.cl). In extended precision they are sums of two
// floats.
#include "kernels/common/common.cl"
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#include "kernels/composite/opacity.cl"

// What the kernel `composite` takes, in all shapes. `splats` are those of the lists, as words:
// single precision has no need of them.
#define COMPOSITE_PARAMETERS                                                                 \
  const CompositeParameters p, __global const Grid *grids, __global const Segment *segments, \
      __global const TileSplat *entries, __global float *planes, __global float *partials,   \
      __global const uint *splats, __global const CloudEntry *clouds,                        \
      __global const CloudSplat *cloud_splats, __global const float *directions,             \
      __global const DirectionCone *cones, __global const Stencil *stencils

// Where a tile's first pixel is, in the first plane.
INLINED size_t first_of_tile(const Grid grid, uint tile) {
  const uint in_grid = tile - grid.first_tile, tiles_x = (uint)grid.tiles_x;
  return first_float(grid) + (size_t)(in_grid / tiles_x * TILE_HEIGHT) * grid.stride +
         (size_t)(in_grid % tiles_x * TILE_WIDTH);
}

#define NUMBERS (PLANES / PLANES_OF_NUMBER)

#if EXTENDED_NUMBERS
INLINED VALUE load_number(__global const float* at, size_t plane) {
  return TO_VALUE(LOAD(at)) + TO_VALUE(LOAD(at + plane));
}
INLINED void store_number(VALUE number, __global float* at, size_t plane) {
  STORE(TO_FLOATS(number), at);
  STORE(TO_FLOATS(number - TO_VALUE(TO_FLOATS(number))), at + plane);
}
#else
#define load_number(at, plane) LOAD(at)
#define store_number(number, at, plane) STORE(number, at)
#endif

// Unrolled, so that numbers stay in registers: PoCL leaves other loops as they are.
INLINED void load_numbers(__global const float* at, size_t plane, VALUE* numbers) {
#pragma unroll
  for (int c = 0; c < NUMBERS; ++c)
    numbers[c] = load_number(at + c * PLANES_OF_NUMBER * plane, plane);
}
INLINED void store_numbers(const VALUE* numbers, __global float* at, size_t plane) {
#pragma unroll
  for (int c = 0; c < NUMBERS; ++c)
    store_number(numbers[c], at + c * PLANES_OF_NUMBER * plane, plane);
}

// Puts a layer behind what is in front of it.
INLINED void add_behind(VALUE* front, const VALUE* layer) {
#if LIGHT_ORDERED
#pragma unroll
  for (int c = 0; c < 3; ++c) {
    const VALUE transmittance = transmittance_of(front[c + 3]);
    front[c] += transmittance * layer[c];
    front[c + 3] = carry_behind(front[c + 3], transmittance, layer[c + 3]);
  }
#else
#pragma unroll
  for (int c = 0; c < NUMBERS; ++c)
    front[c] += layer[c];
#endif
}
