// The rows and columns of their tile that eight entries of a list touch, all at once: to find those
// of one takes a processor as long as to draw a small splat, since each step waits for the last.
typedef struct EntryWindows {
  int first_row[LANES], last_row[LANES];
  int first_column[LANES], last_column[LANES];
#ifdef NARROW_SPLATS
  int pixels[LANES];       // of a narrow splat's window, or 0
  int x[LANES], y[LANES];  // its first pixel
  // Its first edges from the center, in pixels: widths divide them when an edge may be at the
  // center, which is to stay there.
  float across[LANES], along[LANES], per_sigma[LANES];
  float scale[LANES];  // of the product of both axes
#endif
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

#ifdef NARROW_SPLATS
// Of those that are taken as means, most of a large snapshot, all that does not differ from pixel
// to pixel. Windows are as wide as fit one call: GRAIN pixels along both axes, or SEVEN along each.
#define GRAIN 3
#define SEVEN 7
INLINED void find_narrow_splats(__global const TileSplat* entries, float mean_sigma,
                                EntryWindows* windows) {
  const VALUE sigma = OF_ENTRIES(entries, sigma);
  const INTEGER first_column = vload8(0, windows->first_column);
  const INTEGER first_row = vload8(0, windows->first_row);
  const INTEGER columns = vload8(0, windows->last_column) - first_column;
  const INTEGER rows = vload8(0, windows->last_row) - first_row;
  const INTEGER is_narrow = (max(columns, rows) < SEVEN) & (min(columns, rows) >= 0) &
                            (sigma > 0.0f) & (sigma < mean_sigma);
  const INTEGER pixels = select((INTEGER)(SEVEN), (INTEGER)(GRAIN), max(columns, rows) < GRAIN);
  const INTEGER x = min(first_column, TILE_WIDTH - pixels);
  const INTEGER y = min(first_row, TILE_HEIGHT - pixels);
  STORE(pixels & is_narrow, windows->pixels);
  STORE(x, windows->x);
  STORE(y, windows->y);
  STORE(TO_VALUE(x) + (FIRST_X - 0.5f) - OF_ENTRIES(entries, x), windows->across);
  STORE(TO_VALUE(y) + (FIRST_Y - 0.5f) - OF_ENTRIES(entries, y), windows->along);
  STORE(1.0f / sigma, windows->per_sigma);
  STORE(sigma * sigma * (PIXEL_MEAN_SCALE * PIXEL_MEAN_SCALE), windows->scale);
}
#endif

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

static inline int2 rows_of_entry(const EntryWindows* windows, int i) {
  return (int2)(windows->first_row[i], windows->last_row[i]);
}
static inline int2 columns_of_entry(const EntryWindows* windows, int i) {
  return (int2)(windows->first_column[i], windows->last_column[i]);
}
