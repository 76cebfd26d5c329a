// exp(-x^2) and erf(x), on VALUEs (lanes.cl, lanes_of_16.cl).
#include "kernels/common/common.cl"

// 2^f on [-1/2, 1/2]: relative error 7.5e-8, within single precision ...
OVERLOADED static inline VALUE exp2_to_all_digits(VALUE f) {
  VALUE p = f * 1.53458118e-4f + 1.33999314e-3f;
  p = p * f + 9.61848896e-3f;
  p = p * f + 5.55032878e-2f;
  p = p * f + 0.240226469f;
  p = p * f + 0.693147206f;
  return p * f + 1.0f;
}

// ... and 2.7e-6.
OVERLOADED static inline VALUE exp2_to_five_digits(VALUE f) {
  VALUE p = f * 9.57010165e-3f + 5.59178621e-2f;
  p = p * f + 0.240247448f;
  p = p * f + 0.693121815f;
  return p * f + 0.999999261f;
}

#define exp2_of_fraction(x) (FULL_PRECISION ? exp2_to_all_digits(x) : exp2_to_five_digits(x))

// 1.5 * 2^23: added to a number, it rounds it to an integer and leaves it in the low bits, from
// where it becomes an exponent.
#define TO_LOW_BITS 12582912.0f

OVERLOADED static inline VALUE times_power_of_two(VALUE value, VALUE in_low_bits) {
  return AS_VALUE(AS_INTEGER(value) + (AS_INTEGER(in_low_bits) << 23));
}

// 2^t for t <= 0. NATIVE_EXP2: that of a GPU, where it has been found as exact as five digits
// (src/device/opencl/device_context.h).
OVERLOADED static inline VALUE exp2_negative(VALUE t) {
  if (NATIVE_EXP2) return native_exp2(t);
  t = max(t, (VALUE)(-126.0f));
  const VALUE shifted = t + TO_LOW_BITS;
  return times_power_of_two(exp2_of_fraction(t - (shifted - TO_LOW_BITS)), shifted);
}

// exp(-d^2 / sigma^2) with inverse = log2(e) / sigma^2.
OVERLOADED static inline VALUE gaussian(VALUE d, float inverse) {
  return exp2_negative(d * d * -inverse);
}

// erf as x p(x^2), constant beyond its range: absolute error 2.3e-6, its even and its odd powers
// apart, so that half as many steps wait for each other; 1 at the end, so that a grain loses no
// light ...
OVERLOADED static inline VALUE erf_to_five_digits(VALUE x) {
  x = clamp(x, (VALUE)(-3.35f), (VALUE)(3.35f));
  const VALUE u = x * x * 0.178213418f - 1.0f, u2 = u * u;
  VALUE even = u2 * 0.00507548125f + 0.0106919426f;
  VALUE odd = u2 * -0.00167480623f - 0.00681981444f;
  even = even * u2 + 0.0398923457f;
  odd = odd * u2 - 0.0227231216f;
  even = even * u2 + 0.0851068124f;
  odd = odd * u2 - 0.0600429699f;
  even = even * u2 + 0.150861576f;
  odd = odd * u2 - 0.114826418f;
  even = even * u2 + 0.421811938f;
  odd = odd * u2 - 0.208845526f;
  return x * (odd * u + even);
}

// ... and 2.3e-7.
OVERLOADED static inline VALUE erf_to_all_digits(VALUE x) {
  x = clamp(x, (VALUE)(-4.0f), (VALUE)(4.0f));
  const VALUE u = x * x * 0.125f - 1.0f;
  VALUE p = u * -0.00112648448f + 0.00287871086f;
  p = p * u - 0.00193891837f;
  p = p * u + 0.0021022954f;
  p = p * u - 0.00888558477f;
  p = p * u + 0.0166786499f;
  p = p * u - 0.022508679f;
  p = p * u + 0.0319979824f;
  p = p * u - 0.0456971191f;
  p = p * u + 0.0601460151f;
  p = p * u - 0.0747480616f;
  p = p * u + 0.0901783258f;
  p = p * u - 0.10770832f;
  p = p * u + 0.13167648f;
  p = p * u - 0.176576287f;
  p = p * u + 0.353530973f;
  return x * p;
}

#define error_function(x) (FULL_PRECISION ? erf_to_all_digits(x) : erf_to_five_digits(x))
