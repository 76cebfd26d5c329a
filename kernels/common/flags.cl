// Flags of 32 work-items in a row, as bits of a word, that of the first item the highest. Each item
// knows one; all of the group read them after a barrier.
#include "kernels/common/common.cl"

#define FLAGS 32
#define BIT_OF(k) (0x80000000u >> (k))

typedef struct Flags {
#ifdef HAS_BALLOT
  uint bits;
#else
  uint of_four[FLAGS / 4];
#endif
} Flags;

// `k`: which of the 32 the item is. All 32 must be at the same place of the program.
// HAS_BALLOT: they run as one on NVIDIA's GPUs, and vote. Elsewhere a byte each, since atomic
// operations of as many items on one word wait for each other.
INLINED void store_flag(__local Flags* flags, uint k, int flag) {
#ifdef HAS_BALLOT
  uint bits;
  __asm__ volatile(
      "{ .reg .pred is_set; .reg .b32 votes; setp.ne.s32 is_set, %1, 0; "
      "vote.sync.ballot.b32 votes, is_set, 0xffffffff; brev.b32 %0, votes; }"
      : "=r"(bits)
      : "r"(flag));
  if (k == 0) flags->bits = bits;
#else
  ((__local uchar*)flags->of_four)[k] = (uchar)(flag != 0);
#endif
}

INLINED uint bits_of_flags(const __local Flags* flags) {
#ifdef HAS_BALLOT
  return flags->bits;
#else
  // Bytes of 0 or 1, four at a time: the product's highest byte has theirs as bits.
  uint bits = 0;
  for (uint i = 0; i < FLAGS / 4; ++i)
    bits = bits << 4 | flags->of_four[i] * 0x08040201u >> 24;
  return bits;
#endif
}

// Of these bits the first, which is taken away.
INLINED uint take_first(uint* bits) {
  const uint k = clz(*bits);
  *bits ^= BIT_OF(k);
  return k;
}

// The bits behind the first n set ones of `counted`, which has as many at least: from the next set
// one on.
static inline uint bits_behind(uint counted, uint n) {
  for (uint k = 0; k < n; ++k)
    take_first(&counted);
  return counted != 0 ? 0xffffffffu >> clz(counted) : 0u;
}
