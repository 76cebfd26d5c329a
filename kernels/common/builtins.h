// The functions of OpenCL C that kernels call, as the language declares them. A compiler that reads
// declarations of all its 15000 functions before each program takes longer for them than for the
// program; with this file it need not (program_text.h). Where it has read them, nothing changes.
// Each function has all scalar types, since a call for one that is missing would take another. Of
// vectors, which are not converted, there are those that kernels have.

// Clang notes that vectors wider than a processor's registers are passed otherwise than they would
// be with them. All of a program is compiled alike.
#pragma clang diagnostic ignored "-Wpsabi"

#define BUILTIN __attribute__((overloadable))
#define BUILTIN_CONST __attribute__((overloadable, const))
#define BUILTIN_PURE __attribute__((overloadable, pure))

// DECLARE(T, INT, UINT) for a type, and integers with as many bits.
// clang-format off
#define EACH_WIDTH(DECLARE, T, INT, UINT) \
  DECLARE(T, INT, UINT) \
  DECLARE(T##2, INT##2, UINT##2) \
  DECLARE(T##4, INT##4, UINT##4) \
  DECLARE(T##8, INT##8, UINT##8) \
  DECLARE(T##16, INT##16, UINT##16)
#define EACH_INTEGER(DECLARE) \
  DECLARE(char, char, uchar) \
  DECLARE(uchar, char, uchar) \
  DECLARE(short, short, ushort) \
  DECLARE(ushort, short, ushort) \
  EACH_WIDTH(DECLARE, int, int, uint) \
  EACH_WIDTH(DECLARE, uint, int, uint) \
  EACH_WIDTH(DECLARE, long, long, ulong) \
  EACH_WIDTH(DECLARE, ulong, long, ulong)
#ifdef cl_khr_fp64
#define EACH_FLOAT(DECLARE) \
  EACH_WIDTH(DECLARE, float, int, uint) \
  EACH_WIDTH(DECLARE, double, long, ulong)
#define EACH_SCALAR_FLOAT(DECLARE) DECLARE(float) DECLARE(double)
#else
#define EACH_FLOAT(DECLARE) EACH_WIDTH(DECLARE, float, int, uint)
#define EACH_SCALAR_FLOAT(DECLARE) DECLARE(float)
#endif
#define EACH_SCALAR(DECLARE) \
  DECLARE(char) DECLARE(uchar) DECLARE(short) DECLARE(ushort) \
  DECLARE(int) DECLARE(uint) DECLARE(long) DECLARE(ulong) \
  EACH_SCALAR_FLOAT(DECLARE)

// Work-items.
size_t BUILTIN_CONST get_global_id(uint);
size_t BUILTIN_CONST get_global_size(uint);
size_t BUILTIN_CONST get_group_id(uint);
size_t BUILTIN_CONST get_local_id(uint);
size_t BUILTIN_CONST get_local_size(uint);
void __attribute__((overloadable, convergent)) barrier(cl_mem_fence_flags);

// Of floats.
#define DECLARE(T, INT, UINT) \
  T BUILTIN_CONST asinh(T); \
  T BUILTIN_CONST atan2(T, T); \
  T BUILTIN_CONST ceil(T); \
  T BUILTIN_CONST copysign(T, T); \
  T BUILTIN_CONST erf(T); \
  T BUILTIN_CONST exp(T); \
  T BUILTIN_CONST expm1(T); \
  T BUILTIN_CONST fabs(T); \
  T BUILTIN_CONST floor(T); \
  T BUILTIN_CONST fma(T, T, T); \
  T BUILTIN_CONST fmin(T, T); \
  T BUILTIN_CONST log(T); \
  T BUILTIN_CONST rint(T); \
  T BUILTIN_CONST sqrt(T);
EACH_FLOAT(DECLARE)
#undef DECLARE

#define DECLARE(T, INT, UINT) \
  INT BUILTIN_CONST isfinite(T); \
  T BUILTIN_CONST native_exp2(T);
EACH_WIDTH(DECLARE, float, int, uint)
#undef DECLARE

// Of integers.
#define DECLARE(T, INT, UINT) \
  UINT BUILTIN_CONST abs(T); \
  T BUILTIN_CONST clz(T); \
  T BUILTIN_CONST popcount(T);
EACH_INTEGER(DECLARE)
#undef DECLARE

#define DECLARE(T, INT, UINT) int BUILTIN_CONST any(T);
DECLARE(char, char, uchar)
DECLARE(short, short, ushort)
EACH_WIDTH(DECLARE, int, int, uint)
EACH_WIDTH(DECLARE, long, long, ulong)
#undef DECLARE

// Of both.
#define DECLARE(T, INT, UINT) \
  T BUILTIN_CONST clamp(T, T, T); \
  T BUILTIN_CONST max(T, T); \
  T BUILTIN_CONST min(T, T); \
  T BUILTIN_CONST select(T, T, INT); \
  T BUILTIN_CONST select(T, T, UINT);
EACH_INTEGER(DECLARE)
EACH_FLOAT(DECLARE)
#undef DECLARE

// Of all lanes of a vector and one number.
#define EACH_VECTOR(DECLARE, T) \
  DECLARE(T##2, T) DECLARE(T##4, T) DECLARE(T##8, T) DECLARE(T##16, T)
#define DECLARE(V, T) \
  V BUILTIN_CONST clamp(V, T, T); \
  V BUILTIN_CONST max(V, T); \
  V BUILTIN_CONST min(V, T);
EACH_VECTOR(DECLARE, int)
EACH_VECTOR(DECLARE, uint)
EACH_VECTOR(DECLARE, float)
#ifdef cl_khr_fp64
EACH_VECTOR(DECLARE, double)
#endif
#undef DECLARE

// From type to type.
#define CONVERSION(FROM, TO, WIDTH) TO##WIDTH BUILTIN_CONST convert_##TO##WIDTH(FROM##WIDTH);
#define DECLARE(FROM) \
  CONVERSION(FROM, float, ) \
  CONVERSION(FROM, float, 2) \
  CONVERSION(FROM, float, 4) \
  CONVERSION(FROM, float, 8) \
  CONVERSION(FROM, float, 16) \
  CONVERSION(FROM, int, ) \
  CONVERSION(FROM, int, 4) \
  CONVERSION(FROM, int, 8) \
  CONVERSION(FROM, int, 16) \
  CONVERSION(FROM, long, ) \
  CONVERSION(FROM, long, 8) \
  CONVERSION(FROM, long, 16) \
  CONVERSION(FROM, ulong, ) \
  CONVERSION(FROM, ulong, 8) \
  CONVERSION(FROM, ulong, 16) \
  int BUILTIN_CONST convert_int_sat(FROM);
EACH_SCALAR(DECLARE)
#undef DECLARE
#ifdef cl_khr_fp64
#define DECLARE(FROM) \
  CONVERSION(FROM, double, ) CONVERSION(FROM, double, 4) \
  CONVERSION(FROM, double, 8) CONVERSION(FROM, double, 16)
EACH_SCALAR(DECLARE)
#undef DECLARE
#endif

// Memory.
#define IN_SPACE(SPACE, T, WIDTH) \
  T##WIDTH BUILTIN_PURE vload##WIDTH(size_t, const SPACE T*); \
  void BUILTIN vstore##WIDTH(T##WIDTH, size_t, SPACE T*);
#define DECLARE(T) \
  IN_SPACE(global, T, 4) IN_SPACE(global, T, 8) IN_SPACE(global, T, 16) \
  IN_SPACE(local, T, 4) IN_SPACE(local, T, 8) IN_SPACE(local, T, 16) \
  IN_SPACE(private, T, 4) IN_SPACE(private, T, 8) IN_SPACE(private, T, 16)
DECLARE(ushort)
DECLARE(int)
DECLARE(uint)
DECLARE(long)
EACH_SCALAR_FLOAT(DECLARE)
#undef DECLARE
#define DECLARE(SPACE, T) \
  T BUILTIN atomic_add(volatile SPACE T*, T); \
  T BUILTIN atomic_and(volatile SPACE T*, T); \
  T BUILTIN atomic_dec(volatile SPACE T*); \
  T BUILTIN atomic_inc(volatile SPACE T*); \
  T BUILTIN atomic_max(volatile SPACE T*, T); \
  T BUILTIN atomic_min(volatile SPACE T*, T); \
  T BUILTIN atomic_or(volatile SPACE T*, T);
DECLARE(global, int)
DECLARE(global, uint)
DECLARE(local, int)
DECLARE(local, uint)
#undef DECLARE
// clang-format on
