// What splats add to pixels in extended precision, eight of a row at a time, in planes of PLANE
// doubles: sums or, in order, light and transmittances. Doubles of these lose no digits to layers,
// since each is multiplied by what the next layer lets through.
#include "kernels/bin/bin.h"
#include "kernels/common/common.cl"
#include "kernels/common/double_lanes.cl"
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#include "kernels/common/splat.h"
// Planes have eight doubles at a time.
#define VALUE double8
#define LOAD(p) vload8(0, p)
#define STORE(v, p) vstore8(v, 0, p)
#define TO_VALUE convert_double8
#define TO_FLOATS convert_float8
#include "kernels/composite/planes.cl"

#pragma OPENCL FP_CONTRACT ON

#define TILE_PIXELS (TILE_WIDTH * TILE_HEIGHT)
#define GROUP (TILE_PIXELS / 8)
#define SUMS 3
// Eight pixels of the tile, which begin at multiples of eight.
#define load_doubles(p) (*(const double8*)(p))
#define store_doubles(v, p) (*(double8*)(p) = (v))

// What a splat adds to a channel at its center.
typedef struct Channel {
  double emission, summed;
} Channel;

#if LIGHT_ORDERED
// The splat's layer behind what is already there: with u = t X phi(A X) light grows by E u, and the
// transmittance t loses A u. Of layers of this depth and less three terms of phi's series serve,
// whose error is y^3 / 24.
#define THINNEST_LAYER 1e-3
INLINED void add_thin(double* source, double8 covered, const Channel of) {
  double* const passing = source + SUMS * PLANE;
  const double8 t = load_doubles(passing), u = t * covered;
  store_doubles(load_doubles(source) + u * of.emission, source);
  store_doubles(t - u * of.summed, passing);
}

INLINED void add_thinnest_layer(double* source, double8 shape, const Channel of) {
  const double second = 0.5 * of.summed, third = of.summed * of.summed * (1.0 / 6);
  add_thin(source, shape - shape * shape * (second - shape * third), of);
}

INLINED void add_thin_layer(double* source, double8 shape, const Channel of) {
  add_thin(source, shape * phi_of_thin(shape * of.summed), of);
}

INLINED void add_layer(double* source, double8 shape, const Channel of) {
  double* const passing = source + SUMS * PLANE;
  const double8 t = load_doubles(passing), depth = shape * of.summed;
  const double8 series = phi_of_thin(depth), passed = exp_of_minus(min(depth, (double8)(700.0)));
  const long8 is_thick = depth > THIN_LAYER;
  const double8 phi = select(series, (1.0 - passed) / max(depth, (double8)(THIN_LAYER)), is_thick);
  store_doubles(load_doubles(source) + t * shape * phi * of.emission, source);
  store_doubles(t * select(1.0 - depth * series, passed, is_thick), passing);
}
#endif

INLINED void add_sum(double* sum, double8 shape, const Channel of) {
  store_doubles(load_doubles(sum) + shape * of.summed, sum);
}

typedef struct Channels {
  Channel red, green, blue;
} Channels;

INLINED Channel channel_of(const ExtendedSplat* splat, int c) {
  const Channel channel = {in_full(splat->emission[c]), in_full(splat->summed[c])};
  return channel;
}
INLINED Channels channels_of(const ExtendedSplat* splat) {
  const Channels channels = {channel_of(splat, 0), channel_of(splat, 1), channel_of(splat, 2)};
  return channels;
}

// Eight pixels of all channels, written out: what a loop took from an array it would fetch anew for
// every row.
#define ADD_EIGHT(ADD, pixel, shape, of) \
  ADD(pixel, shape, of.red);             \
  ADD((pixel) + PLANE, shape, of.green); \
  ADD((pixel) + 2 * PLANE, shape, of.blue)

// DO with the formula that is exact for these channels. No mean is more than 1, and none more than
// the light below a pixel.
#if LIGHT_ORDERED
#define WITH_FORMULA_FOR(of, DO)                                                   \
  const double deepest = max(of.red.summed, max(of.green.summed, of.blue.summed)); \
  if (deepest <= THINNEST_LAYER) {                                                 \
    DO(add_thinnest_layer);                                                        \
  } else if (deepest <= THIN_LAYER) {                                              \
    DO(add_thin_layer);                                                            \
  } else {                                                                         \
    DO(add_layer);                                                                 \
  }
#else
#define WITH_FORMULA_FOR(of, DO) DO(add_sum);
#endif

// Where number `item` of eights of pixels of a segment's tile lies: in the planes, or in the
// segment's own layer, whose planes are `plane` floats long.
INLINED __global float* own_pixels(const Segment segment, const Grid grid, __global float* planes,
                                   __global float* partials, uint item, size_t* plane) {
  *plane = segment.partial == NO_PARTIAL ? grid.plane_size : TILE_PIXELS;
  if (segment.partial != NO_PARTIAL)
    return partials + (size_t)segment.partial * PLANES * TILE_PIXELS + item * 8;
  return planes + first_of_tile(grid, segment.tile) +
         (size_t)(item * 8 / TILE_WIDTH) * grid.stride + item * 8 % TILE_WIDTH;
}

// Between the tile and planes, which hold what others do (opacity.cl).
static inline void take_pixels(double* tile, __global const float* from, size_t plane,
                               int is_empty) {
  double8 numbers[NUMBERS];
  if (!is_empty) load_numbers(from, plane, numbers);
  for (int c = 0; c < NUMBERS; ++c) {
    const double8 number = is_empty ? (double8)(0.0) : numbers[c];
    store_doubles(c < SUMS ? number : transmittance_of(number), tile + c * PLANE);
  }
}

static inline void give_pixels(const double* tile, __global float* to, size_t plane) {
  double8 numbers[NUMBERS];
  for (int c = 0; c < NUMBERS; ++c) {
    const double8 number = load_doubles(tile + c * PLANE);
    numbers[c] = c < SUMS ? number : carry((double8)(0.0), 1.0 - number, number);
  }
  store_numbers(numbers, to, plane);
}
