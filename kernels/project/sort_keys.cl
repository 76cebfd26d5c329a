// Sort keys of splats: the order of an ordered frame, and of which part of it splats are.
#include "kernels/common/common.cl"
#include "kernels/common/lanes.cl"
#include "kernels/project/depth_key.cl"
#include "kernels/project/load.cl"
#include "kernels/project/project.h"

#pragma OPENCL FP_CONTRACT OFF

#define SORT_KEYS (OUTPUT_KEYS || COUNT_KEYS)

// Order-preserving: smaller floats become smaller integers, -0 and +0 the same one.
static inline INTEGER field_key(VALUE value) {
  const INTEGER bits = AS_INTEGER(choose(value, (VALUE)(0.0f), value == 0.0f));
  return bits ^ ((bits >> 31) | (INTEGER)(int)0x80000000u);
}

// Of particles from i on, whose sort fields are `values`: 48 bits, ascending with the order.
INLINED UNSIGNED_WIDE sort_keys_of(const Columns columns, uint i, uint end, VALUE values,
                                   const ProjectParameters p) {
  if (p.sort_by_field) {
    const INTEGER key = field_key(values);
    return (TO_UNSIGNED_WIDE(p.sort_descending ? ~key : key) & 0xffffffffUL) << 16;
  }
  const UNSIGNED_WIDE key = depth_of(load_vectors(columns.positions, i, end), p.depth_key).key;
  return p.sort_descending ? key ^ 0xffffffffffffUL : key;
}

static inline int is_in_window(ulong key, const ProjectParameters p) {
  return key >= (ulong)wide_integer(p.launch.window_first) &&
         key < (ulong)wide_integer(p.launch.window_end);
}

static inline uint bin_of(ulong key, const ProjectParameters p) {
  return (uint)(key >> p.launch.bin_shift) & (KEY_BINS - 1u);
}
