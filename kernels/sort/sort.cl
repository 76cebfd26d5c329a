// Least-significant-digit radix sort of (key, value) pairs, 8-bit digits, stable:
// histogram, scan, scatter. A work-item walks one block of pairs in order; no work-item
// waits for another, so no forward progress is assumed.
// Also, per block, the bits that are set in some keys and in all of them: a digit that is the
// same for all needs no pass.
#include "kernels/common/common.cl"
#include "kernels/sort/short_run.cl"
#include "kernels/sort/sort.h"

KERNEL_BODY void histogram_of_block(const SortParameters p, __global const uint* keys,
                                    __global uint* histograms, __global KeyBits* bits, uint block) {
  const uint begin = block * p.block_length;
  const uint end = min(begin + p.block_length, p.count);
  uint histogram[SORT_DIGITS];
  for (uint d = 0; d < SORT_DIGITS; ++d)
    histogram[d] = 0;
  uint some = 0, all = ~0u;
  for (uint first = begin; first < end; first += NUMBERS_OF_LINE) {
    ask_for(keys + first + NUMBERS_AHEAD);
    const uint line_end = min(first + NUMBERS_OF_LINE, end);
    for (uint i = first; i < line_end; ++i) {
      const uint key = keys[i];
      some |= key;
      all &= key;
      ++histogram[(key >> p.shift) & (SORT_DIGITS - 1)];
    }
  }
  for (uint d = 0; d < SORT_DIGITS; ++d)
    histograms[d * p.block_count + block] = histogram[d];
  bits[block].some = some;
  bits[block].all = all;
}

__kernel void sort_histogram(const SortParameters p, __global const uint* keys,
                             __global uint* histograms, __global KeyBits* bits) {
  const uint block = piece_of_item(p.block_count);
  if (block != NO_PIECE) histogram_of_block(p, keys, histograms, bits, block);
}

// Exclusive scan over all digits and blocks, in place: where each block's first pair of a
// digit goes. 256 numbers per block: one work-item.
KERNEL_BODY void scan_histograms(__global uint* histograms, uint count) {
  uint running = 0;
  for (uint i = 0; i < count; ++i) {
    const uint here = histograms[i];
    histograms[i] = running;
    running += here;
  }
}

__kernel void sort_scan(const SortParameters p, __global uint* histograms) {
  if (get_global_id(0) == 0) scan_histograms(histograms, SORT_DIGITS * p.block_count);
}

// Pairs of a digit lie side by side, those of different digits all over memory.
#define PAIRS_AHEAD 16

KERNEL_BODY void scatter_block(const SortParameters p, __global const uint* keys,
                               __global const uint* values, __global const uint* histograms,
                               __global uint* sorted_keys, __global uint* sorted_values,
                               uint block) {
  const uint begin = block * p.block_length;
  const uint end = min(begin + p.block_length, p.count);
  uint next[SORT_DIGITS];
  for (uint d = 0; d < SORT_DIGITS; ++d)
    next[d] = histograms[d * p.block_count + block];
  for (uint first = begin; first < end; first += NUMBERS_OF_LINE) {
    ask_for(keys + first + NUMBERS_AHEAD);
    ask_for(values + first + NUMBERS_AHEAD);
    const uint line_end = min(first + NUMBERS_OF_LINE, end);
    for (uint i = first; i < line_end; ++i) {
      const uint key = keys[i];
      const uint place = next[(key >> p.shift) & (SORT_DIGITS - 1)]++;
      sorted_keys[place] = key;
      sorted_values[place] = values[i];
      ask_to_write(sorted_keys + place + PAIRS_AHEAD);
      ask_to_write(sorted_values + place + PAIRS_AHEAD);
    }
  }
}

__kernel void sort_scatter(const SortParameters p, __global const uint* keys,
                           __global const uint* values, __global const uint* histograms,
                           __global uint* sorted_keys, __global uint* sorted_values) {
  const uint block = piece_of_item(p.block_count);
  if (block != NO_PIECE)
    scatter_block(p, keys, values, histograms, sorted_keys, sorted_values, block);
}

// Keys of 48 bits come as 32 upper bits, which are sorted as above, and as ends: the 16 bits below
// them, of which most keys need none. ends[v] belongs to value v, wherever that is.

// The bits that are set in some and in all of a block's keys.
KERNEL_BODY void bits_of_block(const SortParameters p, __global const uint* keys,
                               __global KeyBits* bits, uint block) {
  const uint begin = block * p.block_length;
  const uint end = min(begin + p.block_length, p.count);
  uint some = 0, all = ~0u;
  for (uint i = begin; i < end; ++i) {
    some |= keys[i];
    all &= keys[i];
  }
  bits[block].some = some;
  bits[block].all = all;
}

__kernel void sort_bits(const SortParameters p, __global const uint* keys, __global KeyBits* bits) {
  const uint block = piece_of_item(p.block_count);
  if (block != NO_PIECE) bits_of_block(p, keys, bits, block);
}

// Where all keys share their upper bits, as many of their ends' take their place: all but the
// lowest `shift`.
KERNEL_BODY void take_in_ends_of_block(const SortParameters p, __global const ushort* ends,
                                       __global const uint* values, __global uint* keys,
                                       uint block) {
  const uint begin = block * p.block_length;
  const uint end = min(begin + p.block_length, p.count);
  for (uint i = begin; i < end; ++i) {
    ask_for(ends + values[i] + 2 * NUMBERS_AHEAD);
    ask_for(values + i + NUMBERS_AHEAD);
    ask_to_write(keys + i + NUMBERS_AHEAD);
    keys[i] = (keys[i] << (16 - p.shift)) | ((uint)ends[values[i]] >> p.shift);
  }
}

__kernel void sort_take_in_ends(const SortParameters p, __global const ushort* ends,
                                __global const uint* values, __global uint* keys) {
  const uint block = piece_of_item(p.block_count);
  if (block != NO_PIECE) take_in_ends_of_block(p, ends, values, keys, block);
}

static inline int run_is_in_order(__global const ushort* ends, __global const uint* values,
                                  uint length) {
  for (uint i = 1; i < length; ++i) {
    if (ends[values[i]] < ends[values[i - 1]]) return 0;
  }
  return 1;
}

// One pass of a stable radix sort.
static inline void sort_run_by_digit(__global const ushort* ends, __global const uint* from,
                                     __global uint* to, uint length, uint shift) {
  uint next[SORT_DIGITS];
  for (uint d = 0; d < SORT_DIGITS; ++d)
    next[d] = 0;
  for (uint i = 0; i < length; ++i)
    ++next[(ends[from[i]] >> shift) & (SORT_DIGITS - 1)];
  uint running = 0;
  for (uint d = 0; d < SORT_DIGITS; ++d) {
    const uint count = next[d];
    next[d] = running;
    running += count;
  }
  for (uint i = 0; i < length; ++i)
    to[next[(ends[from[i]] >> shift) & (SORT_DIGITS - 1)]++] = from[i];
}

// Whether any of eight keys from number i on equals the next.
static inline int have_equals(__global const uint* keys, uint i) {
  return any(vload8(0, keys + i) == vload8(0, keys + i + 1));
}

// So many keys before a run is looked at its ends are asked for: they lie all over memory.
#define RUNS_AHEAD 64

static inline void ask_for_ends(__global const uint* keys, __global const uint* values,
                                __global const ushort* ends, uint i) {
  if (!have_equals(keys, i)) return;
  for (uint k = 0; k <= 8; ++k)
    ask_for(ends + values[i + k]);
}

KERNEL_BODY void sort_runs_of_block(const SortParameters p, __global const uint* keys,
                                    __global const ushort* ends, __global uint* values,
                                    __global uint* scratch, uint block) {
  const uint begin = block * p.block_length;
  const uint end = min(begin + p.block_length, p.count);
  for (uint i = begin; i < end; ++i) {
    // Hardly any keys are those of a run.
    ask_for(keys + i + NUMBERS_AHEAD);
    if (p.count - i > RUNS_AHEAD + 8) ask_for_ends(keys, values, ends, i + RUNS_AHEAD);
    if (p.count - i > 8 && !have_equals(keys, i)) {
      i += 7;
      continue;
    }
    const uint key = keys[i];
    if (i + 1 == p.count || keys[i + 1] != key || (i > 0 && keys[i - 1] == key)) continue;
    uint length = 2;
    while (i + length < p.count && keys[i + length] == key)
      ++length;
    if (run_is_in_order(ends, values + i, length)) continue;
    if (length <= SORT_SHORT_RUN) {
      sort_short_run(ends, values + i, length);
    } else {
      sort_run_by_digit(ends, values + i, scratch + i, length, 0);
      sort_run_by_digit(ends, scratch + i, values + i, length, SORT_DIGIT_BITS);
    }
  }
}

// Puts each run of equal sorted keys into the order of their ends. The block in which a run begins
// has all of it. `scratch` is as long as `values`.
__kernel void sort_runs(const SortParameters p, __global const uint* keys,
                        __global const ushort* ends, __global uint* values,
                        __global uint* scratch) {
  const uint block = piece_of_item(p.block_count);
  if (block != NO_PIECE) sort_runs_of_block(p, keys, ends, values, scratch, block);
}
