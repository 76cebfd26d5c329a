// Discs of sums, of a kernel that is cut and taken at pixels' centers, up to sixteen pixels wide:
// what does not differ from pixel to pixel is worked out for eight entries at once, and no loop
// over columns is left. Wider ones wait (waiting.cl).
#if !defined(LIGHT_ORDERED) && defined(CUT_BY_ROWS) && !defined(SAMPLING_MEAN) && \
    !defined(ELLIPSES) && !defined(FINE_PLACES) && !defined(ROWS_OF_16) && SUMMED == 3
#define NARROW_DISCS

typedef struct NarrowDiscs {
  int columns[LANES];      // of the window: 8, 16, or 0 of other splats
  int x[LANES], y[LANES];  // its first pixel
  int rows[LANES];
  float across[LANES], along[LANES];  // of its center from the splat's
  float factor[LANES];                // of squares of distances, for an exponent of 2
  float cut2[LANES];
} NarrowDiscs;

INLINED void find_narrow_discs(__global const TileSplat* entries, const EntryWindows* windows,
                               NarrowDiscs* discs) {
  const VALUE sigma = OF_ENTRIES(entries, sigma), radius = OF_ENTRIES(entries, radius);
  const INTEGER first_column = vload8(0, windows->first_column);
  const INTEGER first_row = vload8(0, windows->first_row);
  const INTEGER width = vload8(0, windows->last_column) - first_column + 1;
  const INTEGER height = vload8(0, windows->last_row) - first_row + 1;
  const INTEGER fits = (max(width, height) <= 16) & (sigma > 0.0f);
  const INTEGER columns = select((INTEGER)(16), (INTEGER)(8), width <= 8);
  const INTEGER x = min(first_column, TILE_WIDTH - columns);
  STORE(columns & fits, discs->columns);
  STORE(x, discs->x);
  STORE(first_row, discs->y);
  STORE(height, discs->rows);
  STORE(TO_VALUE(x) + FIRST_X - OF_ENTRIES(entries, x), discs->across);
  STORE(TO_VALUE(first_row) + FIRST_Y - OF_ENTRIES(entries, y), discs->along);
  STORE(-1.44269504f / (sigma * sigma), discs->factor);
  STORE(radius * radius, discs->cut2);
}

// Eight columns of a disc, of which `squares` are the distances from its center.
INLINED void add_columns(float* pixel, float8 across, float8 squares, const float* along,
                         const float* limits, int rows, __global const TileSplat* splat) {
  SUMMED_CHANNELS
  for (int k = 0; k < rows; ++k, pixel += ROW) {
    const float8 shape = select((float8)(along[k]), (float8)(0.0f), squares > limits[k]);
    ADD_CHANNELS
  }
}

INLINED void add_narrow_disc(float* tile, const NarrowDiscs* discs, int i,
                             __global const TileSplat* splat) {
  const float8 ramp = (float8)(0, 1, 2, 3, 4, 5, 6, 7);
  const float factor = discs->factor[i], cut2 = discs->cut2[i];
  const int rows = discs->rows[i];
  float along[16], limits[16];
#pragma unroll
  for (int k = 0; k < 16; k += 8) {
    if (k >= rows) break;
    const float8 distance = discs->along[i] + (ramp + (float)k), square = distance * distance;
    store_eight(exp2_negative(square * factor), along + k);
    store_eight(cut2 - square, limits + k);
  }
  float* pixel = tile + discs->y[i] * ROW + discs->x[i];
#pragma unroll
  for (int x = 0; x < 16; x += 8) {
    if (x >= discs->columns[i]) return;
    const float8 distance = discs->across[i] + (ramp + (float)x), square = distance * distance;
    add_columns(pixel + x, exp2_negative(square * factor), square, along, limits, rows, splat);
  }
}
#endif
