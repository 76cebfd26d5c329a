// Sort keys of splats: the order of an ordered frame, and of which part of it splats are.

#if defined(OUTPUT_KEYS) || defined(KEY_WINDOW)
#define SORT_KEYS

// Order-preserving: smaller floats become smaller integers, -0 and +0 the same one.
inline uint field_key(float value) {
  const uint bits = as_uint(value == 0.0f ? 0.0f : value);
  return bits ^ ((bits >> 31) ? 0xffffffffu : 0x80000000u);
}

// Of particle i, whose sort field is `value`: 48 bits, ascending with the order.
INLINED ulong sort_key_of(__global const float* positions, uint i, float value,
                          const ProjectParameters p) {
  if (p.sort_by_field) {
    const uint key = field_key(value);
    return (ulong)(p.sort_descending ? ~key : key) << 16;
  }
  const ulong key = depth_of(positions + (size_t)i * 3, p.depth_key).key;
  return p.sort_descending ? key ^ 0xffffffffffffUL : key;
}
#endif

#ifdef KEY_WINDOW
inline int is_in_window(ulong key, const ProjectParameters p) {
  return key >= (ulong)wide_integer(p.window_first) && key < (ulong)wide_integer(p.window_end);
}
#endif

#ifdef COUNT_KEYS
inline uint bin_of(ulong key, const ProjectParameters p) {
  return (uint)(key >> p.bin_shift) & (KEY_BINS - 1u);
}
#endif
