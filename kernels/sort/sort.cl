// Least-significant-digit radix sort of (key, value) pairs, 8-bit digits, stable:
// histogram, scan, scatter. A work-item walks one block of pairs in order; no work-item
// waits for another, so no forward progress is assumed.
// Also, per block, the bits that are set in some keys and in all of them: a digit that is the
// same for all needs no pass.
__kernel void sort_histogram(const SortParameters p, __global const uint* keys,
                             __global uint* histograms, __global KeyBits* bits) {
  const uint block = get_global_id(0);
  const uint begin = block * p.block_length;
  const uint end = min(begin + p.block_length, p.count);
  uint histogram[SORT_DIGITS];
  for (uint d = 0; d < SORT_DIGITS; ++d)
    histogram[d] = 0;
  uint some = 0, all = ~0u;
  for (uint i = begin; i < end; ++i) {
    const uint key = keys[i];
    some |= key;
    all &= key;
    ++histogram[(key >> p.shift) & (SORT_DIGITS - 1)];
  }
  for (uint d = 0; d < SORT_DIGITS; ++d)
    histograms[d * p.block_count + block] = histogram[d];
  bits[block].some = some;
  bits[block].all = all;
}

// Exclusive scan over all digits and blocks, in place: where each block's first pair of a
// digit goes. 256 numbers per block: one work-item.
__kernel void sort_scan(const SortParameters p, __global uint* histograms) {
  if (get_global_id(0) != 0) return;
  uint running = 0;
  for (uint i = 0; i < SORT_DIGITS * p.block_count; ++i) {
    const uint count = histograms[i];
    histograms[i] = running;
    running += count;
  }
}

__kernel void sort_scatter(const SortParameters p, __global const uint* keys,
                           __global const uint* values, __global const uint* histograms,
                           __global uint* sorted_keys, __global uint* sorted_values) {
  const uint block = get_global_id(0);
  const uint begin = block * p.block_length;
  const uint end = min(begin + p.block_length, p.count);
  uint next[SORT_DIGITS];
  for (uint d = 0; d < SORT_DIGITS; ++d)
    next[d] = histograms[d * p.block_count + block];
  for (uint i = begin; i < end; ++i) {
    const uint key = keys[i];
    const uint place = next[(key >> p.shift) & (SORT_DIGITS - 1)]++;
    sorted_keys[place] = key;
    sorted_values[place] = values[i];
  }
}
