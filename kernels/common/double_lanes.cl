// Eight doubles at a time, in extended precision; in memory they are sums of two floats. exp of the
// compiler's own takes them one by one.
#include "kernels/common/grid.h"

#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#pragma OPENCL FP_CONTRACT ON

static inline double in_full(FloatPair a) {
  return (double)a.high + (double)a.low;
}
static inline double8 sum_of_parts(float8 high, float8 low) {
  return convert_double8(high) + convert_double8(low);
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

// phi(y) = (1 - exp(-y)) / y by five terms of its series, whose error is y^5 / 720: of layers that
// are no deeper than this.
#define THIN_LAYER 0.03
static inline double8 phi_of_thin(double8 y) {
  return 1.0 - y * (0.5 - y * (1.0 / 6 - y * (1.0 / 24 - y * (1.0 / 120))));
}
