// Splats that a window of sort keys leaves over, put before those of the next one.

// Work-item: number k of them. It takes slot k with the smallest key, which the next window's are
// never below, and keeps its place among equal ones.
__kernel void carry_splats(const uint first, const uint words, const uint has_ends,
                           __global const uint* order, __global const uint* from, __global uint* to,
                           __global uint* keys, __global ushort* key_ends,
                           __global uint* next_order) {
  const uint k = get_global_id(0);
  const size_t source = (size_t)order[first + k] * words, target = (size_t)k * words;
  for (uint w = 0; w < words; ++w)
    to[target + w] = from[source + w];
  keys[k] = 0;
  if (has_ends) key_ends[k] = 0;
  next_order[k] = k;
}
