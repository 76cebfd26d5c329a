// Eight extended numbers (extended.cl) at a time: what compositing does in every pixel.
#include "kernels/extended/extended.cl"

#pragma OPENCL FP_CONTRACT OFF

#if DOUBLE_NUMBERS
typedef double8 ExtendedLanes;

static inline ExtendedLanes lanes_pair(float8 high, float8 low) {
  return convert_double8(high) + convert_double8(low);
}
static inline float8 high_lanes(ExtendedLanes a) {
  return convert_float8(a);
}
static inline float8 low_lanes(ExtendedLanes a) {
  return convert_float8(a - convert_double8(convert_float8(a)));
}
static inline ExtendedLanes lanes_sum(ExtendedLanes a, ExtendedLanes b) {
  return a + b;
}
static inline ExtendedLanes lanes_product(ExtendedLanes a, Extended b) {
  return a * b;
}
#else
typedef struct ExtendedLanes {
  float8 high, low;
} ExtendedLanes;

static inline ExtendedLanes lanes_pair(float8 high, float8 low) {
  ExtendedLanes pair;
  pair.high = high;
  pair.low = low;
  return pair;
}
static inline float8 high_lanes(ExtendedLanes a) {
  return a.high;
}
static inline float8 low_lanes(ExtendedLanes a) {
  return a.low;
}
static inline ExtendedLanes renormalized_lanes(float8 a, float8 b) {
  const float8 sum = a + b;
  return lanes_pair(sum, select((float8)(0.0f), b - (sum - a), isfinite(sum)));
}
static inline ExtendedLanes lanes_sum(ExtendedLanes a, ExtendedLanes b) {
  const float8 high = a.high + b.high, back = high - a.high;
  const float8 high_rest = (a.high - (high - back)) + (b.high - back);
  const float8 low = a.low + b.low, low_back = low - a.low;
  const float8 low_rest = (a.low - (low - low_back)) + (b.low - low_back);
  const ExtendedLanes first = renormalized_lanes(high, high_rest + low);
  return renormalized_lanes(first.high, first.low + low_rest);
}
static inline ExtendedLanes lanes_product(ExtendedLanes a, Extended b) {
  const float8 high = a.high * b.x;
  return renormalized_lanes(high, fma(a.high, (float8)(b.x), -high) + (a.high * b.y + a.low * b.x));
}
#endif
