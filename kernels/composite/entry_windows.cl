// The rows and columns of their tile that eight entries of a list touch, all at once: to find those
// of one takes a processor as long as to draw a small splat, since each step waits for the last.
typedef struct EntryWindows {
  int first_row[LANES], last_row[LANES];
  int first_column[LANES], last_column[LANES];
} EntryWindows;

// pixel_range() of common.cl, of eight.
INLINED void fill_range(VALUE center, VALUE radius, float first_center, int size, int* first,
                        int* last) {
  const VALUE none = (VALUE)(0.0f), end = (VALUE)((float)size);
  const VALUE low = center - radius - first_center, high = center + radius - first_center;
  const VALUE from = choose(none, choose(end, low, low < end), low > none);
  const VALUE to = choose(end - 1.0f, choose(none - 1.0f, high, high > -1.0f), high < end - 1.0f);
  const INTEGER truncated_from = TO_INTEGER(from), truncated_to = TO_INTEGER(to);
  // A vector's comparison gives -1.
  STORE(truncated_from - (TO_VALUE(truncated_from) < from), first);
  STORE(truncated_to + (TO_VALUE(truncated_to) > to), last);
}

INLINED void find_windows(__global const TileSplat* entries, EntryWindows* windows) {
  const VALUE radius = OF_ENTRIES(entries, radius);
#ifdef ELLIPSES
  const VALUE radius_x = OF_ENTRIES(entries, along_x.radius);
#else
  const VALUE radius_x = radius;
#endif
  fill_range(OF_ENTRIES(entries, y), radius, FIRST_Y, TILE_HEIGHT, windows->first_row,
             windows->last_row);
  fill_range(OF_ENTRIES(entries, x), radius_x, FIRST_X, TILE_WIDTH, windows->first_column,
             windows->last_column);
}

#define ENTRIES_AHEAD 32

static inline int2 rows_of_entry(const EntryWindows* windows, int i) {
  return (int2)(windows->first_row[i], windows->last_row[i]);
}
static inline int2 columns_of_entry(const EntryWindows* windows, int i) {
  return (int2)(windows->first_column[i], windows->last_column[i]);
}
