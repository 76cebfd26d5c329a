// Splats of some blocks, put in order of the parts that their sort keys lie in, as long as they are
// in a processor's cache. So all splats of a part lie in a few runs, in the order of their
// particles, and are sorted and fetched without waiting for memory.

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

// Work-item: one piece of p.piece_blocks blocks, whose splats lie at block * stride of the launch
// and come to lie side by side from the piece's first block on, of all. first_slots has
// p.part_count + 1 numbers per piece: where its runs begin, and where the last one ends.
__kernel void place_in_parts(const KeyPartParameters p, __global const BlockCounts* counts,
                             __global const SplatWords* splats, __global const uint* keys,
                             __global const ushort* key_ends, __global const uchar* part_of_bin,
                             __global SplatWords* to_splats, __global uint* to_keys,
                             __global ushort* to_ends, __global uint* first_slots) {
  const uint pieces = p.block_count / p.piece_blocks + (p.block_count % p.piece_blocks != 0);
  const uint piece = piece_of_item(pieces);
  if (piece == NO_PIECE) return;
  const uint begin = piece * p.piece_blocks, end = min(begin + p.piece_blocks, p.block_count);
  uint next[MOST_KEY_PARTS];
  for (uint part = 0; part < MOST_KEY_PARTS; ++part)
    next[part] = 0;
  uint filled = (p.first_block + begin) * p.stride;
  for (uint block = begin; block < end; ++block) {
    const uint first = block * p.stride, visible = counts[p.first_block + block].visible;
    for (uint k = 0; k < visible; ++k) {
      ++next[part_of(keys[first + k], p, part_of_bin)];
      // Where all of them will be written to, all over it.
      ask_to_write(to_splats + filled + k);
      ask_to_write(to_keys + filled + k);
      if (p.has_ends) ask_to_write(to_ends + filled + k);
    }
    filled += visible;
  }
  __global uint* starts = first_slots + (size_t)(p.first_piece + piece) * (p.part_count + 1);
  uint slot = (p.first_block + begin) * p.stride;
  for (uint part = 0; part < p.part_count; ++part) {
    const uint count = next[part];
    next[part] = starts[part] = slot;
    slot += count;
  }
  starts[p.part_count] = slot;
  for (uint block = begin; block < end; ++block) {
    const uint first = block * p.stride, visible = counts[p.first_block + block].visible;
    for (uint k = 0; k < visible; ++k) {
      const uint from = first + k, key = keys[from];
      const uint to = next[part_of(key, p, part_of_bin)]++;
      copy_splat(splats + from, to_splats + to);
      to_keys[to] = key;
      if (p.has_ends) to_ends[to] = key_ends[from];
    }
  }
}

// The keys of all pieces' splats without gaps, one piece after the other; `order` takes where the
// splats lie. offsets[piece]: how many come before.
__kernel void gather_keys(const uint part_count, __global const uint* first_slots,
                          __global const uint* offsets, __global const uint* keys,
                          __global uint* to_keys, __global uint* order) {
  const uint piece = get_global_id(0);
  __global const uint* starts = first_slots + (size_t)piece * (part_count + 1);
  const uint first = starts[0], count = starts[part_count] - first, to = offsets[piece];
  for (uint k = 0; k < count; ++k) {
    to_keys[to + k] = keys[first + k];
    order[to + k] = first + k;
  }
}
