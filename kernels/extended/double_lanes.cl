// Eight doubles at a time, for compositing in extended precision; in memory they are sums of two
// floats. exp and 1 - erf of the compiler's own take them one by one.
#include "kernels/common/grid.h"

#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#pragma OPENCL FP_CONTRACT ON

static inline double in_full(FloatPair a) {
  return (double)a.high + (double)a.low;
}
static inline double8 sum_of_parts(float8 high, float8 low) {
  return convert_double8(high) + convert_double8(low);
}
static inline float8 low_part(double8 a) {
  return convert_float8(a - convert_double8(convert_float8(a)));
}

static inline double8 ramp_of_eight() {
  return (double8)(0, 1, 2, 3, 4, 5, 6, 7);
}

// exp(-y) for -700 <= y <= 700, relative error 1e-14. 1.5 * 2^52, added to a number, rounds it to
// an integer and leaves it in the low bits; ln 2 is in two parts, the first so short that its
// multiples are exact.
static inline double8 exp_of_minus(double8 y) {
  const double magic = 6755399441055744.0;
  const double8 shifted = y * -1.4426950408889634 + magic;
  const double8 n = shifted - magic;
  const double8 r = (-y - n * 0.69314718036912382) - n * 1.9082149292705877e-10;
  double8 p = r * 2.505210838544172e-8 + 2.755731922398589e-7;
  p = p * r + 2.7557319223985893e-6;
  p = p * r + 2.48015873015873e-5;
  p = p * r + 1.984126984126984e-4;
  p = p * r + 1.3888888888888889e-3;
  p = p * r + 8.333333333333333e-3;
  p = p * r + 4.1666666666666664e-2;
  p = p * r + 1.6666666666666666e-1;
  p = p * r + 0.5;
  p = p * r + 1.0;
  p = p * r + 1.0;
  return as_double8(as_long8(p) + (as_long8(shifted) << 52));
}

// 1 - erf(x) for x >= 0, relative error 2e-13, constant beyond 10, where it is 2e-45: exp(-x^2)
// times t p(t), t = 1 / (1 + 0.3 x).
static inline double8 complement_of_erf(double8 x) {
  x = select(x, (double8)(10.0), x > 10.0);
  const double8 t = 1.0 / (x * 0.3 + 1.0);
  const double8 u = t * 2.6633499170812605 - 1.6633499170812602;
  double8 p = u * 1.3713151503225163e-08 - 8.77463435244863e-09;
  p = p * u - 2.462352296506154e-07;
  p = p * u + 1.0819245677140543e-07;
  p = p * u + 3.7965347814972183e-06;
  p = p * u + 2.01333015250639e-06;
  p = p * u - 5.942947643920726e-05;
  p = p * u - 0.00017468308762321827;
  p = p * u + 0.0005556065304134251;
  p = p * u + 0.006260002068530397;
  p = p * u + 0.02740483063072595;
  p = p * u + 0.0802093028859574;
  p = p * u + 0.17598545081592057;
  p = p * u + 0.3015555022098291;
  p = p * u + 0.40825774066188303;
  return t * p * exp_of_minus(x * x);
}
