// What splats add to pixels in extended precision, eight of a row at a time, in planes of PLANE
// doubles: sums or, in order, light and transmittances. Doubles of these lose no digits to layers,
// since each is multiplied by what the next layer lets through.
#include "kernels/common/common.cl"
#include "kernels/composite/extended_pixels.cl"
#include "kernels/extended/double_lanes.cl"
#include "kernels/extended/extended_splat.h"

#pragma OPENCL FP_CONTRACT ON

#define SUMS 3
#if LIGHT_ORDERED
#define TILE_PLANES 6
#else
#define TILE_PLANES 3
#endif
// Eight pixels of the tile, which begin at multiples of eight.
#define load_doubles(p) (*(const double8*)(p))
#define store_doubles(v, p) (*(double8*)(p) = (v))
#define DARKEST 1e-300  // of transmittances: their logarithm is a number

// What a splat adds to a channel at its center.
typedef struct Channel {
  double emission, summed;
} Channel;

#if LIGHT_ORDERED
// The splat's layer behind what is already there: with u = t X phi(A X) light grows by E u, and the
// transmittance t loses A u. Of layers of these depths and less phi(y) = (1 - exp(-y)) / y is taken
// by three terms of its series, whose error is y^3 / 24, and by five, whose error is y^5 / 720.
#define THINNEST_LAYER 1e-3
#define THIN_LAYER 0.03
INLINED double8 phi_of_thin(double8 y) {
  return 1.0 - y * (0.5 - y * (1.0 / 6 - y * (1.0 / 24 - y * (1.0 / 120))));
}

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

// Between the tile and pixels in memory, which hold depths.
static inline void take_pixels(double* tile, const Pixels pixels) {
  for (int c = 0; c < SUMS; ++c) {
    store_doubles(pixels.light[c], tile + c * PLANE);
#if LIGHT_ORDERED
    store_doubles(exp_of_minus(min(pixels.depth[c], (double8)(690.0))), tile + (c + SUMS) * PLANE);
#endif
  }
}

static inline Pixels give_pixels(const double* tile) {
  Pixels pixels;
  for (int c = 0; c < SUMS; ++c) {
    pixels.light[c] = load_doubles(tile + c * PLANE);
#if LIGHT_ORDERED
    const double8 passing = load_doubles(tile + (c + SUMS) * PLANE);
    pixels.depth[c] = -log(max(passing, (double8)(DARKEST)));
#endif
  }
  return pixels;
}
