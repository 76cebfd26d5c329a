// Splats, or where they lie, without the gaps between the blocks that they were projected in.
#include "kernels/project/project.h"

// Group: one block, whose splats lie at block * stride, and come to lie behind those of the blocks
// before, from `first_slot` on, with their keys. `words` of a splat.
__kernel void compact(const uint first_slot, const uint stride, const uint words,
                      const uint has_ends, __global const BlockCounts* counts,
                      __global const uint* offsets, __global const uint* splats,
                      __global const uint* keys, __global const ushort* key_ends,
                      __global uint* to_splats, __global uint* to_keys, __global ushort* to_ends,
                      __global uint* order) {
  const uint block = get_group_id(0), count = counts[block].visible;
  const uint from = block * stride, to = first_slot + offsets[block];
  __global const uint* source = splats + (size_t)from * words;
  __global uint* target = to_splats + (size_t)to * words;
  for (size_t i = get_local_id(0); i < (size_t)count * words; i += get_local_size(0))
    target[i] = source[i];
  for (uint k = get_local_id(0); k < count; k += get_local_size(0)) {
    to_keys[to + k] = keys[from + k];
    if (has_ends) to_ends[to + k] = key_ends[from + k];
    order[to + k] = to + k;
  }
}

// Where the splats of all blocks lie, which stay there; with has_keys the upper bits of their keys
// as well.
__kernel void list_slots(const uint stride, const uint has_keys, __global const BlockCounts* counts,
                         __global const uint* offsets, __global const uint* keys,
                         __global uint* to_keys, __global uint* order) {
  const uint block = get_group_id(0), count = counts[block].visible;
  const uint from = block * stride, to = offsets[block];
  for (uint k = get_local_id(0); k < count; k += get_local_size(0)) {
    if (has_keys) to_keys[to + k] = keys[from + k];
    order[to + k] = from + k;
  }
}
