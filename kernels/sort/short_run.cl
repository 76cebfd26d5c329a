// The order of a few values by the ends of their keys.
static inline void sort_short_run(__global const ushort* ends, __global uint* values, uint length) {
  for (uint i = 1; i < length; ++i) {
    const uint value = values[i];
    const ushort key_end = ends[value];
    uint place = i;
    for (; place > 0 && ends[values[place - 1]] > key_end; --place)
      values[place] = values[place - 1];
    values[place] = value;
  }
}
