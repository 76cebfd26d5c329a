// One particle or pixel at a time on a GPU, eight on a processor, or sixteen where its registers
// hold as many: LANES_8 and LANES_16 choose; with DOUBLE_VALUES, of extended precision, one in
// double precision. Stages written in VALUE and INTEGER share every formula between them. A
// compiler keeps away from registers of sixteen floats but in a function that is called with some.
#include "kernels/common/common.cl"

#pragma OPENCL FP_CONTRACT ON

#undef VALUE
#undef INTEGER
#undef AS_VALUE
#undef AS_INTEGER
#undef ANY
#undef OR_OF_LANES
#undef LANES
#if DOUBLE_VALUES
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#elif defined(LANES_16)
#define LANES 16
#define OF_LANES(name) name##16
#define NUMBERS_OF_LANES (int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)
#elif defined(LANES_8)
#define LANES 8
#define OF_LANES(name) name##8
#define NUMBERS_OF_LANES (int8)(0, 1, 2, 3, 4, 5, 6, 7)
#endif
#ifndef LANES
#define LANES 1
#define OF_LANES(name) name
#define NUMBERS_OF_LANES 0
#define LOAD(p) (*(p))
#define STORE(v, p) (*(p) = (v))
// A scalar comparison gives 1 where a vector's gives -1; select() wants the top bit of
// vectors and any non-zero scalar, so masks work alike as long as they are only combined
// with & and |.
#define ANY(mask) (mask)
#else
#define LOAD(p) OF_LANES(vload)(0, p)
#define STORE(v, p) OF_LANES(vstore)(v, 0, p)
// Two instructions, where PoCL's any() looks at one lane after the other.
#ifdef __has_builtin
#if __has_builtin(__builtin_reduce_or)
#define OR_OF_LANES(bits) __builtin_reduce_or(bits)
#define ANY(mask) (OR_OF_LANES(mask) != 0)
#endif
#endif
#ifndef ANY
#define ANY(mask) any(mask)
#endif
#endif
#if DOUBLE_VALUES
#define VALUE double
// The bits of a float: of numbers that are stored, whatever VALUE is.
#define AS_VALUE(bits) ((double)as_float(bits))
#define AS_INTEGER(value) as_int((float)(value))
#define TO_VALUE convert_double
#define TO_FLOATS convert_float
#else
#define VALUE OF_LANES(float)
#define AS_VALUE OF_LANES(as_float)
#define AS_INTEGER OF_LANES(as_int)
#define TO_VALUE OF_LANES(convert_float)
#endif
#define INTEGER OF_LANES(int)
#define WIDE OF_LANES(long)
#define UNSIGNED_WIDE OF_LANES(ulong)
#define AS_WIDE OF_LANES(as_long)
#define TO_INTEGER OF_LANES(convert_int)
#define TO_WIDE OF_LANES(convert_long)
#define TO_UNSIGNED_WIDE OF_LANES(convert_ulong)

// 0 where a mask is false, its bits where it is true: masks as loop conditions per lane.
static inline VALUE choose(VALUE if_false, VALUE if_true, INTEGER mask) {
#if DOUBLE_VALUES
  return mask ? if_true : if_false;
#else
  return select(if_false, if_true, mask);
#endif
}

// log2 of a positive, finite number, absolute error 8e-8 and a rounding of the result, relative
// error near 1 3e-7: exponent, and t p(t) for 1 + t in [sqrt(1/2), sqrt(2)], its even and its odd
// powers apart. No quotient: processors take as long for one as for ten steps of it.
static inline VALUE log2_positive(VALUE x) {
#if DOUBLE_VALUES
  return log(x) * 1.4426950408889634;
#else
  const INTEGER denormal = x < 1.17549435e-38f;
  x = choose(x, x * 16777216.0f, denormal);
  const INTEGER bits = AS_INTEGER(x) - 0x3f3504f3;
  const INTEGER exponent = bits >> 23;
  const VALUE t = AS_VALUE((bits & 0x007fffff) + 0x3f3504f3) - 1.0f, t2 = t * t;
  VALUE even = t2 * 0.12541227f + 0.217379421f;
  VALUE odd = t2 * -0.210303292f - 0.238519445f;
  even = even * t2 + 0.287656665f;
  odd = odd * t2 - 0.360721201f;
  even = even * t2 + 0.48092252f;
  odd = odd * t2 - 0.721347153f;
  even = even * t2 + 1.4426949f;
  return TO_VALUE(exponent) + t * (odd * t + even) -
         choose((VALUE)(0.0f), (VALUE)(24.0f), denormal);
#endif
}

// Of one lane.
INLINED float value_of(VALUE values, uint k) {
#if DOUBLE_VALUES
  return (float)values;
#else
  return ((const float*)&values)[k];
#endif
}
INLINED int integer_of(INTEGER values, uint k) {
  return ((const int*)&values)[k];
}

// The bits of all lanes together.
static inline uint or_of_lanes(INTEGER bits) {
#if LANES == 1
  return (uint)bits;
#elif defined(OR_OF_LANES)
  return (uint)OR_OF_LANES(bits);
#else
  int of_lane[LANES], all = 0;
  STORE(bits, of_lane);
  for (uint k = 0; k < LANES; ++k)
    all |= of_lane[k];
  return (uint)all;
#endif
}

// Eight floats at any address in one access: vload8 and vstore8 may become two, and a processor
// cannot forward two stores to one load.
#ifdef __clang__
typedef float8 __attribute__((aligned(4))) Eight;
typedef int8 __attribute__((aligned(4))) EightIntegers;
typedef float4 __attribute__((aligned(4))) Four;
#define load_eight(p) (*(const Eight*)(p))
#define load_eight_integers(p) (*(const EightIntegers*)(p))
#define store_eight(v, p) (*(Eight*)(p) = (v))
#define load_global_eight(p) (*(__global const Eight*)(p))
#define load_global_four(p) (*(__global const Four*)(p))
#define store_global_eight(v, p) (*(__global Eight*)(p) = (v))
#else
#define load_eight(p) vload8(0, p)
#define load_eight_integers(p) vload8(0, p)
#define store_eight(v, p) vstore8(v, 0, p)
#define load_global_eight load_eight
#define load_global_four(p) vload4(0, p)
#define store_global_eight store_eight
#endif

// Eights of numbers taken apart and put together in pairs of neighbors: the steps by which columns
// become rows, or rows columns, in registers. Of two rows of words every other pair, or quad, side
// by side.
INLINED float8 first_words(float8 a, float8 b) {
  return (float8)(a.s0, b.s0, a.s1, b.s1, a.s4, b.s4, a.s5, b.s5);
}
INLINED float8 last_words(float8 a, float8 b) {
  return (float8)(a.s2, b.s2, a.s3, b.s3, a.s6, b.s6, a.s7, b.s7);
}
INLINED float8 first_pairs(float8 a, float8 b) {
  return (float8)(a.s01, b.s01, a.s45, b.s45);
}
INLINED float8 last_pairs(float8 a, float8 b) {
  return (float8)(a.s23, b.s23, a.s67, b.s67);
}
