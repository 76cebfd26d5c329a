// Numbers as sums of two VALUEs (lanes.cl), as extended.cl has them for one particle at a time: at
// least 44 bits on any device.
#pragma OPENCL FP_CONTRACT OFF

typedef struct PairLanes {
  VALUE high, low;
} PairLanes;

static inline PairLanes pair_lanes(FloatPair a) {
  PairLanes pair;
  pair.high = (VALUE)(a.high);
  pair.low = (VALUE)(a.low);
  return pair;
}

// a + b where |a| >= |b| or nearly.
INLINED PairLanes renormalized_pair(VALUE a, VALUE b) {
  PairLanes sum;
  sum.high = a + b;
  sum.low = b - (sum.high - a);
  return sum;
}

INLINED PairLanes exact_sum(VALUE a, VALUE b) {
  PairLanes sum;
  sum.high = a + b;
  const VALUE back = sum.high - a;
  sum.low = (a - (sum.high - back)) + (b - back);
  return sum;
}

INLINED PairLanes sum_of_pairs(PairLanes a, PairLanes b) {
  const PairLanes sum = exact_sum(a.high, b.high);
  return renormalized_pair(sum.high, sum.low + (a.low + b.low));
}

INLINED PairLanes product_of_pairs(PairLanes a, PairLanes b) {
  const VALUE high = a.high * b.high;
  const VALUE low = fma(a.high, b.high, -high) + (a.high * b.low + a.low * b.high);
  return renormalized_pair(high, low);
}

INLINED PairLanes quotient_of_pairs(PairLanes a, PairLanes b) {
  const VALUE first = a.high / b.high;
  const VALUE rest = fma(-first, b.high, a.high) + (a.low - first * b.low);
  return renormalized_pair(first, rest / b.high);
}
