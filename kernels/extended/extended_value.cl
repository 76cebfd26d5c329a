// Numbers of at least 43 bits, as many at a time as a VALUE (lanes.cl) has: a processor's
// doubles, else sums of two VALUEs. The doubles of many GPUs are far slower than their floats.
#include "kernels/common/common.cl"
#include "kernels/common/grid.h"
#include "kernels/common/lanes.cl"

#pragma OPENCL FP_CONTRACT OFF

#if DOUBLE_NUMBERS && LANES > 1
#if LANES == 16
typedef double16 ExtendedValue;
#define TO_EXTENDED convert_double16
#else
typedef double8 ExtendedValue;
#define TO_EXTENDED convert_double8
#endif

static inline ExtendedValue extended_value(FloatPair a) {
  return (ExtendedValue)((double)a.high + (double)a.low);
}
INLINED VALUE high_value(ExtendedValue a) {
  return TO_VALUE(a);
}
INLINED VALUE low_value(ExtendedValue a) {
  return TO_VALUE(a - TO_EXTENDED(TO_VALUE(a)));
}
INLINED ExtendedValue exact_sum(VALUE a, float b) {
  return TO_EXTENDED(a) + (double)b;
}
INLINED ExtendedValue sum_of_extended(ExtendedValue a, ExtendedValue b) {
  return a + b;
}
INLINED ExtendedValue product_of_extended(ExtendedValue a, ExtendedValue b) {
  return a * b;
}
// a b + c.
INLINED ExtendedValue product_plus(ExtendedValue a, ExtendedValue b, ExtendedValue c) {
  return fma(a, b, c);
}
// By the inverse in single precision and one step whose error is the third power of that: to the
// last bit but one or two, in a fraction of the time of a quotient. Of numbers that floats hold.
INLINED ExtendedValue quotient_of_extended(ExtendedValue a, ExtendedValue b) {
  const ExtendedValue about = TO_EXTENDED(1.0f / TO_VALUE(b)), error = fma(-about, b, 1.0);
  return a * fma(about * error, 1.0 + error, about);
}
INLINED ExtendedValue not_below(ExtendedValue a, float least) {
  return max(a, (double)least);
}
#else
typedef struct ExtendedValue {
  VALUE high, low;
} ExtendedValue;

static inline ExtendedValue extended_value(FloatPair a) {
  ExtendedValue pair;
  pair.high = (VALUE)(a.high);
  pair.low = (VALUE)(a.low);
  return pair;
}
static inline VALUE high_value(ExtendedValue a) {
  return a.high;
}
static inline VALUE low_value(ExtendedValue a) {
  return a.low;
}

// a + b where |a| >= |b| or nearly.
INLINED ExtendedValue renormalized_value(VALUE a, VALUE b) {
  ExtendedValue sum;
  sum.high = a + b;
  sum.low = b - (sum.high - a);
  return sum;
}
INLINED ExtendedValue exact_sum_of_values(VALUE a, VALUE b) {
  ExtendedValue sum;
  sum.high = a + b;
  const VALUE back = sum.high - a;
  sum.low = (a - (sum.high - back)) + (b - back);
  return sum;
}
INLINED ExtendedValue exact_sum(VALUE a, float b) {
  return exact_sum_of_values(a, (VALUE)(b));
}
INLINED ExtendedValue sum_of_extended(ExtendedValue a, ExtendedValue b) {
  const ExtendedValue sum = exact_sum_of_values(a.high, b.high);
  return renormalized_value(sum.high, sum.low + (a.low + b.low));
}
INLINED ExtendedValue product_of_extended(ExtendedValue a, ExtendedValue b) {
  const VALUE high = a.high * b.high;
  const VALUE low = fma(a.high, b.high, -high) + (a.high * b.low + a.low * b.high);
  return renormalized_value(high, low);
}
INLINED ExtendedValue product_plus(ExtendedValue a, ExtendedValue b, ExtendedValue c) {
  return sum_of_extended(product_of_extended(a, b), c);
}
INLINED ExtendedValue quotient_of_extended(ExtendedValue a, ExtendedValue b) {
  const VALUE first = a.high / b.high;
  const VALUE rest = fma(-first, b.high, a.high) + (a.low - first * b.low);
  return renormalized_value(first, rest / b.high);
}
INLINED ExtendedValue not_below(ExtendedValue a, float least) {
  a.high = max(a.high, (VALUE)(least));
  return a;
}
#endif
