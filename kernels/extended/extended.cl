// Numbers of at least 45 bits for extended precision: the device's double
// precision where it has one (DOUBLE_NUMBERS), else a pair of floats whose sum is the
// number, the second at most half a unit in the last place of the first. What follows needs
// no more than the pairs give, so both have the same bounds (docs/dev/accuracy.md). In memory
// numbers are pairs always.
#include "kernels/common/grid.h"

#pragma OPENCL FP_CONTRACT OFF

#if DOUBLE_NUMBERS
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
typedef double Extended;

static inline Extended extended_of(float a) {
  return (double)a;
}
static inline Extended extended_pair(FloatPair a) {
  return (double)a.high + (double)a.low;
}
static inline float high_part(Extended a) {
  return (float)a;
}
static inline float low_part(Extended a) {
  return (float)(a - (double)(float)a);
}
static inline Extended extended_negative(Extended a) {
  return -a;
}
static inline Extended extended_sum(Extended a, Extended b) {
  return a + b;
}
static inline Extended extended_product(Extended a, Extended b) {
  return a * b;
}
static inline Extended extended_scaled(Extended a, float power_of_two) {
  return a * (double)power_of_two;
}
static inline Extended extended_quotient(Extended a, Extended b) {
  return a / b;
}
static inline Extended extended_root(Extended a) {
  return sqrt(a);
}
static inline int extended_less(Extended a, Extended b) {
  return a < b;
}
#else
typedef float2 Extended;

static inline Extended extended_of(float a) {
  return (float2)(a, 0.0f);
}
static inline Extended extended_pair(FloatPair a) {
  return (float2)(a.high, a.low);
}
static inline float high_part(Extended a) {
  return a.x;
}
static inline float low_part(Extended a) {
  return a.y;
}
static inline Extended extended_negative(Extended a) {
  return -a;
}

// a + b where |a| >= |b| or a = 0. An infinite sum has no low part.
static inline Extended renormalized(float a, float b) {
  const float sum = a + b;
  const float low = b - (sum - a);
  return (float2)(sum, isfinite(sum) ? low : 0.0f);
}
static inline float2 extended_float_sum(float a, float b) {
  const float sum = a + b;
  const float back = sum - a;
  return (float2)(sum, (a - (sum - back)) + (b - back));
}
static inline Extended extended_sum(Extended a, Extended b) {
  const float2 high = extended_float_sum(a.x, b.x);
  const float2 low = extended_float_sum(a.y, b.y);
  const float2 first = renormalized(high.x, high.y + low.x);
  return renormalized(first.x, first.y + low.y);
}
static inline Extended extended_product(Extended a, Extended b) {
  const float high = a.x * b.x;
  const float low = fma(a.x, b.x, -high) + (a.x * b.y + a.y * b.x);
  return renormalized(high, low);
}
static inline Extended extended_scaled(Extended a, float power_of_two) {
  return a * power_of_two;
}
static inline Extended extended_quotient(Extended a, Extended b) {
  const float first = a.x / b.x;
  const Extended rest = extended_sum(a, extended_negative(extended_product(b, extended_of(first))));
  const float second = rest.x / b.x;
  return isfinite(first) ? renormalized(first, second) : extended_of(first);
}
static inline Extended extended_root(Extended a) {
  if (!(a.x > 0.0f)) return extended_of(0.0f);
  const float root = sqrt(a.x);
  const Extended rest =
      extended_sum(a, extended_negative(extended_product(extended_of(root), extended_of(root))));
  return renormalized(root, rest.x / (2.0f * root));
}
static inline int extended_less(Extended a, Extended b) {
  return a.x < b.x || (a.x == b.x && a.y < b.y);
}
#endif

static inline FloatPair pair_of(Extended a) {
  FloatPair pair;
  pair.high = high_part(a);
  pair.low = low_part(a);
  return pair;
}
static inline Extended extended_constant(float high, float low) {
  FloatPair pair;
  pair.high = high;
  pair.low = low;
  return extended_pair(pair);
}
static inline Extended extended_difference(Extended a, Extended b) {
  return extended_sum(a, extended_negative(b));
}
static inline int is_negative(Extended a) {
  return high_part(a) < 0.0f;
}
static inline Extended extended_magnitude(Extended a) {
  return is_negative(a) ? extended_negative(a) : a;
}

// 2^n for -126 <= n <= 127.
static inline float extended_power_of_two(int n) {
  return as_float((n + 127) << 23);
}

// exp(t) for t <= 80, relative error 3e-9; 0 below -86, where single precision ends.
static inline Extended extended_exp(Extended t) {
  if (!(high_part(t) > -86.0f)) return extended_of(0.0f);
  const float n = rint(high_part(t) * 1.44269504f);
  const Extended ln2 = extended_constant(6.931471825e-01f, -1.904654212e-09f);
  const Extended r = extended_sum(t, extended_product(extended_of(-n), ln2));
  const float f = high_part(r);
  // The terms from r^3 on are small enough for single precision, |r| <= 0.35.
  float tail = f * 2.75573192e-6f + 2.48015873e-5f;
  tail = tail * f + 1.98412698e-4f;
  tail = tail * f + 1.38888889e-3f;
  tail = tail * f + 8.33333333e-3f;
  tail = tail * f + 4.16666667e-2f;
  tail = tail * f + 1.66666667e-1f;
  tail = tail * f * f * f;
  const Extended square = extended_scaled(extended_product(r, r), 0.5f);
  const Extended sum =
      extended_sum(extended_of(1.0f), extended_sum(r, extended_sum(square, extended_of(tail))));
  return extended_scaled(sum, extended_power_of_two((int)n));
}

// erfc(x) for x >= 0, relative error 5e-9; 0 from 9.2 on, where exp(-x^2) ends above. As
// (1 + 2 x) exp(x^2) erfc(x), a smooth function of x / (x + 3): Chebyshev polynomial of
// degree 14 over [0, 12].
static inline Extended extended_erfc(Extended x) {
  if (!(high_part(x) < 9.2f)) return extended_of(0.0f);
  const Extended place = extended_quotient(x, extended_sum(x, extended_of(3.0f)));
  const Extended z =
      extended_difference(extended_product(place, extended_of(2.5f)), extended_of(1.0f));
  const float f = high_part(z);
  float tail = f * -2.041410454e-07f - 3.219571738e-07f;
  tail = tail * f + 2.862102292e-06f;
  tail = tail * f + 5.002209036e-06f;
  tail = tail * f - 3.482328248e-05f;
  tail = tail * f - 4.348198490e-05f;
  tail = tail * f + 4.948288552e-04f;
  Extended p = extended_of(tail);
  p = extended_sum(extended_product(p, z), extended_constant(-3.045031917e-04f, -5.610564097e-12f));
  p = extended_sum(extended_product(p, z), extended_constant(-6.481598131e-03f, -1.143227735e-10f));
  p = extended_sum(extended_product(p, z), extended_constant(3.210152313e-02f, -1.082891110e-09f));
  p = extended_sum(extended_product(p, z), extended_constant(-8.286666125e-02f, -5.373627654e-10f));
  p = extended_sum(extended_product(p, z), extended_constant(1.312227398e-01f, -5.444477313e-09f));
  p = extended_sum(extended_product(p, z), extended_constant(-1.024150252e-01f, 2.890789386e-09f));
  p = extended_sum(extended_product(p, z), extended_constant(-7.730318606e-02f, -2.746548988e-09f));
  p = extended_sum(extended_product(p, z), extended_constant(1.276978374e+00f, 8.024336751e-09f));
  const Extended scale = extended_sum(extended_of(1.0f), extended_scaled(x, 2.0f));
  return extended_quotient(
      extended_product(p, extended_exp(extended_negative(extended_product(x, x)))), scale);
}

// exp(t) for |t| <= 47, relative error 2e-12: of a sixteenth of what is left of whole powers of
// two, whose terms from the third on are small enough for single precision.
static inline Extended extended_exp_of_log(Extended t) {
  const float n = rint(high_part(t) * 1.44269504f);
  const Extended ln2 = extended_constant(6.931471825e-01f, -1.904654212e-09f);
  const Extended r =
      extended_scaled(extended_sum(t, extended_product(extended_of(-n), ln2)), 0.0625f);
  const float f = high_part(r);
  const float tail = f * f * f * (1.66666667e-1f + f * (4.16666667e-2f + f * 8.33333333e-3f));
  const Extended square = extended_scaled(extended_product(r, r), 0.5f);
  Extended p =
      extended_sum(extended_of(1.0f), extended_sum(r, extended_sum(square, extended_of(tail))));
  for (int i = 0; i < 4; ++i)
    p = extended_product(p, p);
  return extended_scaled(p, extended_power_of_two((int)n));
}

// ln(x) of a positive, finite number, absolute error 8e-12: one step of Newton's from single
// precision.
static inline Extended extended_log(Extended x) {
  // Denormals and numbers near the largest stay inside exp's range.
  const float size = high_part(x);
  const int tiny = size<1e-20f, huge = size> 1e20f;
  const Extended middle = extended_scaled(x, tiny ? 0x1p84f : huge ? 0x1p-64f : 1.0f);
  const Extended guess = extended_of(log(high_part(middle)));
  const Extended ratio = extended_product(middle, extended_exp_of_log(extended_negative(guess)));
  const Extended error = extended_difference(ratio, extended_of(1.0f));
  const float square = 0.5f * high_part(error) * high_part(error);
  const Extended ln2 = extended_constant(6.931471825e-01f, -1.904654212e-09f);
  const Extended moved = extended_product(ln2, extended_of(tiny ? -84.0f : huge ? 64.0f : 0.0f));
  const Extended step = extended_difference(error, extended_of(square));
  return extended_sum(moved, extended_sum(guess, step));
}

// ln(1 + x), x >= 0, relative error 1e-10.
static inline Extended extended_log_of_one_more(Extended x) {
  const Extended two = extended_of(2.0f);
  if (!(high_part(x) < 0.1f)) return extended_log(extended_sum(extended_of(1.0f), x));
  // By the series of artanh.
  const Extended t = extended_quotient(x, extended_sum(two, x));
  const float square = high_part(t) * high_part(t);
  const float rest =
      high_part(t) * square *
      (0.333333333f + square * (0.2f + square * (0.142857143f + square * 0.111111111f)));
  return extended_product(two, extended_sum(t, extended_of(rest)));
}

// asinh(v), absolute error 3e-11, relative 3e-10.
static inline Extended extended_asinh(Extended v) {
  const float size = fabs(high_part(v));
  const Extended a = high_part(v) < 0.0f ? extended_negative(v) : v;
  Extended result;
  if (size < 0.1f) {
    // v - v^3 / 6 + 3 v^5 / 40 - 5 v^7 / 112 + 35 v^9 / 1152
    const float square = size * size;
    const float rest =
        square *
        (-0.166666667f + square * (0.075f + square * (-0.0446428571f + square * 0.0303819444f)));
    result = extended_sum(a, extended_of(size * rest));
  } else if (size > 1e6f) {
    // ln(2 v) + 1 / (4 v^2)
    result = extended_sum(extended_log(a), extended_constant(6.931471825e-01f, -1.904654212e-09f));
  } else {
    const Extended root = extended_root(extended_sum(extended_product(a, a), extended_of(1.0f)));
    result = extended_log(extended_sum(a, root));
  }
  return high_part(v) < 0.0f ? extended_negative(result) : result;
}
