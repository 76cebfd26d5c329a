// Splats wider or higher than seven pixels in windows of sixteen columns, for processors whose
// registers hold as many floats, to the bits of windows of eight (splat_rows.cl). All that such a
// splat takes is one call: between calls a compiler keeps no constants in registers.
#if defined(ROWS_OF_16) && !defined(ELLIPSES) && (defined(LIGHT_ORDERED) || !defined(SPLATS_WAIT))
#define WINDOWS_OF_16
#define MOST_WINDOWS 4
#if TILE_WIDTH > 16 * MOST_WINDOWS
#error "a tile has more windows of sixteen columns than are measured at a time"
#endif

// 0 in the first eight lanes, 8 in the others: distances are taken as windows of eight take them.
INLINED float16 eights_of_lanes(void) {
  return (float16)((float8)(0.0f), (float8)(8.0f));
}

// The shape at the centers of the sixteen pixels from pixel `begin` on, to the bits of
// fill_center_values(); `first` and `low` as there. `ramp` counts the lanes of each eight.
INLINED float16 sixteen_centers(float first, float low, int begin, float16 ramp, float inverse) {
  return gaussian((first + ramp - low) + ((float)begin + eights_of_lanes()), inverse);
}

// The same of either kind, to the bits of fill_axis(). Of pixel means there are fifteen, between
// sixteen edges; the last lane is 0.
INLINED float16 sixteen_of_axis(float first, float low, int begin, float16 ramp, float sigma,
                                float mean_sigma) {
  if (sigma >= mean_sigma) return sixteen_centers(first, low, begin, ramp, inverse_of(sigma));
  const float16 eights = (float)begin + eights_of_lanes();
  const float16 edges = (first - 0.5f + eights + ramp - low) * (1.0f / sigma);
  const float16 within = error_function(edges);
  return (within.s123456789abcdeff - within) * (PIXEL_MEAN_SCALE * sigma);
}

// The limits of `count` rows, as fill_limits() has them.
INLINED void fill_limits_of_16(float* along, float first, int count, float16 ramp,
                               __global const TileSplat* splat) {
#ifdef CUT_BY_ROWS
  const float cut2 = cut_radius(splat->radius) * cut_radius(splat->radius);
  for (int k = 0; k < count; k += 16) {
    const float16 dy = first + ((float)k + eights_of_lanes()) + ramp - LOW_Y(*splat);
    store_sixteen(cut2 - dy * dy, along + LIMITS + k);
  }
#endif
}

// A splat of at most sixteen columns. Both axes stay in registers. A call whose argument tells the
// compiler that it may use registers of sixteen floats, from which it keeps away otherwise.
__attribute__((noinline)) static void add_window_of_16(float* tile, int2 rows, int column,
                                                       float16 ramp,
                                                       __global const TileSplat* splat,
                                                       float mean_sigma, int form) {
  const float sigma = splat->sigma;
  const float first_x = (float)column + FIRST_X - splat->x;
  const float first_y = (float)rows.x + FIRST_Y - splat->y;
  float along[2 * LIMITS];
  for (int k = 0; k <= rows.y - rows.x; k += 16)
    store_sixteen(sixteen_of_axis(first_y, LOW_Y(*splat), k, ramp, sigma, mean_sigma), along + k);
  fill_limits_of_16(along, first_y, rows.y - rows.x + 1, ramp, splat);
  Window window;
  window.x = column;
  const int skipped = set_rows(&window, rows, 16, splat) - rows.x;
  update_rows_of_16(tile, &window,
                    sixteen_of_axis(first_x, LOW_X(*splat), 0, ramp, sigma, mean_sigma),
                    along + skipped, splat, form);
}

// Whether a splat's columns fit a window of sixteen, and its rows the means of one, which has no
// means for the last column.
static inline int fits_window_of_16(int2 columns, int rows, float sigma, float mean_sigma) {
  const int count = columns.y - columns.x + 1;
  if (count <= 8) return 0;
  if (sigma >= mean_sigma) return count <= 16;
  return sigma > 0.0f && max(count, rows) <= 15 && columns.x <= TILE_WIDTH - 16;
}

#ifdef KERNEL_CUT
// The rows of each window in which the disc reaches into it, of which the first begins at
// `column`. Beyond the disc nothing is drawn, whatever the rows.
typedef struct RowsOfWindows {
  int first[MOST_WINDOWS], last[MOST_WINDOWS];
} RowsOfWindows;

INLINED void find_rows_of_windows(RowsOfWindows* found, int2 rows, int column,
                                  __global const TileSplat* splat) {
  const float4 begin = (float)column + FIRST_X + (float4)(0.0f, 16.0f, 32.0f, 48.0f);
  const float4 center = splat->x;
  const float4 nearest = min(max(center, begin), begin + 15.0f) - center;
  const float4 half_height = sqrt(max(splat->radius * splat->radius - nearest * nearest, 0.0f));
  const float4 low = splat->y - half_height - FIRST_Y, high = splat->y + half_height - FIRST_Y;
  // By comparisons: whatever is not a number takes all rows.
  const float4 top = (float)rows.x, bottom = (float)rows.y;
  const float4 from = select(top, select(bottom + 1.0f, low, low <= bottom), low > top);
  const float4 to = select(bottom, select(top - 1.0f, high, high >= top), high < bottom);
  const int4 first = convert_int4(from);
  vstore4(first - (convert_float4(first) < from), 0, found->first);
  vstore4(convert_int4(to), 0, found->last);
}
#endif

// Windows from `column` on, with the splat's shape along both axes, until `drawn` columns are, as
// many as windows of eight would draw: those beyond may be pixels of the next row.
INLINED void update_windows_of_16(float* tile, int2 rows, int column, int drawn,
                                  const float* across, const float* along,
                                  __global const TileSplat* splat, int form) {
#ifdef KERNEL_CUT
  RowsOfWindows of_windows;
  find_rows_of_windows(&of_windows, rows, column, splat);
#endif
  Window window;
  window.y = rows.x;
  window.rows = rows.y - rows.x + 1;
  for (int k = 0; k < drawn; k += 16) {
    window.x = column + k;
#ifdef KERNEL_CUT
    window.y = of_windows.first[k / 16];
    window.rows = of_windows.last[k / 16] - window.y + 1;
#endif
    const float* of_rows = along + (window.y - rows.x);
    if (drawn - k == 8) {
      update_window(tile, &window, load_eight(across + k), of_rows, splat, form);
      return;
    }
    update_rows_of_16(tile, &window, load_sixteen(across + k), of_rows, splat, form);
  }
}

// A splat that takes values at pixel centers, with any number of columns.
__attribute__((noinline)) static void add_centers_of_16(float* tile, int2 rows, int2 columns,
                                                        float16 ramp,
                                                        __global const TileSplat* splat, int form) {
  const int column = first_of_eights(columns), drawn = (columns.y - columns.x + 8) & ~7;
  const float inverse = inverse_of(splat->sigma);
  const float first_x = (float)column + FIRST_X - splat->x;
  const float first_y = (float)rows.x + FIRST_Y - splat->y;
  const int count = rows.y - rows.x + 1;
  float across[TILE_WIDTH + 16], along[2 * LIMITS];
  for (int k = 0; k < drawn; k += 16)
    store_sixteen(sixteen_centers(first_x, LOW_X(*splat), k, ramp, inverse), across + k);
  for (int k = 0; k < count; k += 16)
    store_sixteen(sixteen_centers(first_y, LOW_Y(*splat), k, ramp, inverse), along + k);
  fill_limits_of_16(along, first_y, count, ramp, splat);
  update_windows_of_16(tile, rows, column, drawn, across, along, splat, form);
}

// fill_axis() of pixel means: `values` has room for 32 more than `count`.
INLINED void fill_means_of_16(float* values, float first, float low, int count, float16 ramp,
                              float sigma) {
  const float per_sigma = 1.0f / sigma;
  for (int k = 0; k <= count; k += 16) {
    const float16 eights = (float)k + eights_of_lanes();
    store_sixteen(error_function((first - 0.5f + eights + ramp - low) * per_sigma), values + k);
  }
  const int end = (count + 7) & ~7;
  if (count < end) values[end] = values[end - 1];
  for (int k = 0; k < count; k += 16) {
    const float16 mean = load_sixteen(values + k + 1) - load_sixteen(values + k);
    store_sixteen(mean * (PIXEL_MEAN_SCALE * sigma), values + k);
  }
}

// A splat that takes pixel means and is not bright, with any number of columns.
__attribute__((noinline)) static void add_means_of_16(float* tile, int2 rows, int2 columns,
                                                      float16 ramp, __global const TileSplat* splat,
                                                      int form) {
  const int column = first_of_eights(columns), count = columns.y - column + 1;
  const float first_y = (float)rows.x + FIRST_Y - splat->y;
  float across[TILE_WIDTH + 32], along[2 * LIMITS];
  fill_means_of_16(across, (float)column + FIRST_X - splat->x, LOW_X(*splat), count, ramp,
                   splat->sigma);
  fill_means_of_16(along, first_y, LOW_Y(*splat), rows.y - rows.x + 1, ramp, splat->sigma);
  fill_limits_of_16(along, first_y, rows.y - rows.x + 1, ramp, splat);
  update_windows_of_16(tile, rows, column, (count + 7) & ~7, across, along, splat, form);
}
#endif
