// exp and phi of full single precision, relative errors below 2e-7 wherever they are not
// negligible (4e-7 for phi where divisions are not rounded correctly), on VALUEs (lanes.cl): for
// light, whose relative error no later step enlarges.
#include "kernels/common/lanes.cl"

#pragma OPENCL FP_CONTRACT ON

// exp(-(high + low)) for high >= 0, |low| far below 1; 0 from 86 on.
static inline VALUE precise_exp_negative(VALUE high, VALUE low) {
  const VALUE t = -min(high, (VALUE)(86.0f));
  const VALUE n = rint(t * 1.44269504f);
  // ln(2) in two floats, the first of few bits, so that its product with n is exact.
  const VALUE r = ((t - n * 0.693145752f) - n * 1.42860677e-6f) - low;
  VALUE p = r * 1.98412698e-4f + 1.38888889e-3f;
  p = p * r + 8.33333333e-3f;
  p = p * r + 4.16666667e-2f;
  p = p * r + 1.66666667e-1f;
  p = p * r + 0.5f;
  p = p * r + 1.0f;
  p = p * r + 1.0f;
  const VALUE scaled = AS_VALUE(AS_INTEGER(p) + (TO_INTEGER(n) << 23));
  return select(scaled, (VALUE)(0.0f), high >= 86.0f);
}

// (1 - exp(-y)) / y for y >= 0: eleven terms of its series up to 1, where 1 - exp(-y) begins
// to keep its digits.
static inline VALUE precise_phi(VALUE y) {
  const VALUE x = -min(y, (VALUE)(1.0f));
  VALUE p = x * 2.50521084e-8f + 2.75573192e-7f;
  p = p * x + 2.75573192e-6f;
  p = p * x + 2.48015873e-5f;
  p = p * x + 1.98412698e-4f;
  p = p * x + 1.38888889e-3f;
  p = p * x + 8.33333333e-3f;
  p = p * x + 4.16666667e-2f;
  p = p * x + 1.66666667e-1f;
  p = p * x + 0.5f;
  p = p * x + 1.0f;
  if (!ANY(y > 1.0f)) return p;
  const VALUE direct = (1.0f - precise_exp_negative(y, (VALUE)(0.0f))) / max(y, (VALUE)(1.0f));
  return select(p, direct, y > 1.0f);
}
