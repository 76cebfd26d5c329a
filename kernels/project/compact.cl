// Splats, or their keys, without the gaps between the blocks that they were projected in.
#include "kernels/project/project.h"

// Work-item: one block, whose splats lie at block * stride, and come to lie behind those of the
// blocks before. `words` of a splat of a window; keys are moved with has_keys only.
__kernel void compact(const uint first_slot, const uint stride, const uint words,
                      const uint has_keys, const uint has_ends, __global const BlockCounts* counts,
                      __global const uint* offsets, __global const uint* splats,
                      __global const uint* keys, __global const ushort* key_ends,
                      __global uint* to_splats, __global uint* to_keys, __global ushort* to_ends,
                      __global uint* order) {
  const uint block = get_global_id(0), count = counts[block].visible;
  const uint from = block * stride, to = first_slot + offsets[block];
  __global const uint* source = splats + (size_t)from * words;
  __global uint* target = to_splats + (size_t)to * words;
  for (size_t i = 0; i < (size_t)count * words; ++i)
    target[i] = source[i];
  for (uint k = 0; has_keys && k < count; ++k) {
    to_keys[to + k] = keys[from + k];
    if (has_ends) to_ends[to + k] = key_ends[from + k];
    order[to + k] = to + k;
  }
}

// The upper bits of the keys of all blocks' splats alone; `order` takes where the splats lie, which
// stay there with the ends of their keys.
__kernel void compact_keys(const uint stride, __global const BlockCounts* counts,
                           __global const uint* offsets, __global const uint* keys,
                           __global uint* to_keys, __global uint* order) {
  const uint block = get_global_id(0), count = counts[block].visible;
  const uint from = block * stride, to = offsets[block];
  for (uint k = 0; k < count; ++k) {
    to_keys[to + k] = keys[from + k];
    order[to + k] = from + k;
  }
}
