// Eights of numbers taken apart and put together in pairs of neighbors: the steps by which columns
// become rows, or rows columns, in registers.
#include "kernels/common/common.cl"

// Of two rows of words every other pair, or quad, side by side.
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
