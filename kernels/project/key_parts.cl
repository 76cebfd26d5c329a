// Splats of some blocks, put in order of the parts that their sort keys lie in, as long as they are
// in a processor's cache. So all splats of a part lie in a few runs, in the order of their
// particles, and are sorted and fetched without waiting for memory.
#include "kernels/common/pieces.cl"
#include "kernels/common/prefetch.cl"
#include "kernels/project/project.h"

typedef struct SplatWords {
  float words[SPLAT_WORDS];
} SplatWords;

static inline void copy_splat(__global const SplatWords* from, __global SplatWords* to) {
#if SPLAT_WORDS == 8
  // In one piece: a structure is copied in pieces.
  vstore8(vload8(0, from->words), 0, to->words);
#else
  *to = *from;
#endif
}

static inline uint part_of(uint key, const KeyPartParameters p, __global const uchar* part_of_bin) {
  const uint above = max(key, p.first_key) - p.first_key;
  return part_of_bin[min(above >> p.shift, KEY_PART_BINS - 1u)];
}

// Work-item: one block, whose splats lie at block * stride of the launch and come to lie at
// block * stride of all. first_slots has p.part_count + 1 numbers per block of all: where its runs
// begin, and where the last one ends.
__kernel void place_in_parts(const KeyPartParameters p, __global const BlockCounts* counts,
                             __global const SplatWords* splats, __global const uint* keys,
                             __global const ushort* key_ends, __global const uchar* part_of_bin,
                             __global SplatWords* to_splats, __global uint* to_keys,
                             __global ushort* to_ends, __global uint* first_slots) {
  const uint block = piece_of_item(p.block_count);
  if (block == NO_PIECE) return;
  const uint numbered = p.first_block + block;
  const uint first = block * p.stride, visible = counts[numbered].visible;
  uint slot = numbered * p.stride;
  uint next[MOST_KEY_PARTS];
  for (uint part = 0; part < MOST_KEY_PARTS; ++part)
    next[part] = 0;
  for (uint k = 0; k < visible; ++k) {
    ++next[part_of(keys[first + k], p, part_of_bin)];
    // Where all of them will be written to, all over it.
    ask_to_write(to_splats + slot + k);
    ask_to_write(to_keys + slot + k);
    if (p.has_ends) ask_to_write(to_ends + slot + k);
  }
  __global uint* starts = first_slots + (size_t)numbered * (p.part_count + 1);
  for (uint part = 0; part < p.part_count; ++part) {
    const uint count = next[part];
    next[part] = starts[part] = slot;
    slot += count;
  }
  starts[p.part_count] = slot;
  for (uint k = 0; k < visible; ++k) {
    const uint from = first + k, key = keys[from];
    const uint to = next[part_of(key, p, part_of_bin)]++;
    copy_splat(splats + from, to_splats + to);
    to_keys[to] = key;
    if (p.has_ends) to_ends[to] = key_ends[from];
  }
}
