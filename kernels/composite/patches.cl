// Splats of sums that are wider or higher than seven pixels wait until there are some, and then a
// patch of the tile stays in registers while all of them are added to it. Row by row each splat
// would load and store pixels that the one before has just stored, and a processor waits for that.
// Only sums may be added up in another order.
#if !defined(LIGHT_ORDERED) && SUMMED == 3 && !defined(FACE_OF_CUBE)
#define WIDE_SPLATS_WAIT

// As many rows as leave registers for a splat.
#ifdef ROWS_OF_16
#define PATCH float16
#define PATCH_WIDTH 16
#define PATCH_HEIGHT 8
#define PATCH_LANES (float16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)
#define load_patch load_sixteen
#define store_patch store_sixteen
#define cut_shape_of_patch cut_shape_of_16
#else
#define PATCH float8
#define PATCH_WIDTH 8
#define PATCH_HEIGHT 4
#define PATCH_LANES (float8)(0, 1, 2, 3, 4, 5, 6, 7)
#define load_patch load_eight
#define store_patch store_eight
#define cut_shape_of_patch cut_shape
#endif
#if TILE_WIDTH % PATCH_WIDTH != 0 || TILE_HEIGHT % PATCH_WIDTH != 0
#error "a tile is not made of whole patches"
#endif

// A bit of a word for each.
#define MOST_WIDE_SPLATS 32

// Splats that wait, one behind the other: their shape along both axes, zero beside their square
// where no limits cut it.
typedef struct WideSplats {
  float across[MOST_WIDE_SPLATS * TILE_WIDTH], along[MOST_WIDE_SPLATS * TILE_HEIGHT];
#ifdef CUT_BY_ROWS
  float limits[MOST_WIDE_SPLATS * TILE_HEIGHT];  // as fill_limits() has them
  float x[MOST_WIDE_SPLATS], y[MOST_WIDE_SPLATS], squeeze[MOST_WIDE_SPLATS];
#endif
  float summed[MOST_WIDE_SPLATS * SUMMED];
  uint of_columns[TILE_WIDTH / PATCH_WIDTH];  // bits of the splats that reach into patches of
  uint of_rows[TILE_HEIGHT / PATCH_HEIGHT];   // these columns, and of these rows
  uint count;
} __attribute__((aligned(64))) WideSplats;

static inline void clear_waiting(WideSplats* waiting) {
  waiting->count = 0;
  for (int i = 0; i < TILE_WIDTH / PATCH_WIDTH; ++i)
    waiting->of_columns[i] = 0;
  for (int i = 0; i < TILE_HEIGHT / PATCH_HEIGHT; ++i)
    waiting->of_rows[i] = 0;
}

// Whether a splat that touches `rows` and `columns` of the tile waits. Bright ones take other
// formulas, one by one.
static inline int waits_for_others(int2 rows, int2 columns, __global const TileSplat* splat) {
  const int2 more = (int2)(columns.y - columns.x, rows.y - rows.x);
  return max(more.x, more.y) >= 7 && min(more.x, more.y) >= 0 && SIGMA_X(*splat) > 0.0f &&
         splat->sigma > 0.0f;
}

#ifdef CUT_BY_ROWS
#define WITHIN_SQUARE(shape, pixel, square) (shape)
#else
#define WITHIN_SQUARE(shape, pixel, square) \
  select(shape, (PATCH)(0.0f), ((pixel) < (float)(square).x) | ((pixel) > (float)(square).y))
#endif

// The shape along an axis of a whole tile, of `count` pixels: which part of it a splat reaches no
// processor foresees. `square` is that part; the center lies at `place` + `low`, the first pixel's
// at `first`.
INLINED void fill_axis_of_tile(float* values, int count, int2 square, float first, float place,
                               float low, float sigma, float mean_sigma, PATCH lanes) {
  PATCH pixel = lanes;
  if (sigma >= mean_sigma) {
    const float inverse = inverse_of(sigma);
    for (int k = 0; k < count; k += PATCH_WIDTH, pixel += (float)PATCH_WIDTH) {
      const PATCH d = (pixel + first) - place - low;
      store_patch(WITHIN_SQUARE(gaussian(d, inverse), pixel, square), values + k);
    }
    return;
  }
  const float per_sigma = 1.0f / sigma;
  for (int k = 0; k < count; k += PATCH_WIDTH, pixel += (float)PATCH_WIDTH) {
    const PATCH d = (pixel + first) - place - low;
    const PATCH mean =
        error_function((d + 0.5f) * per_sigma) - error_function((d - 0.5f) * per_sigma);
    store_patch(WITHIN_SQUARE(mean * (PIXEL_MEAN_SCALE * sigma), pixel, square), values + k);
  }
}

// What cuts the splat in the rows of a tile.
#ifdef CUT_BY_ROWS
INLINED void fill_limits_of_tile(WideSplats* waiting, uint number, PATCH lanes,
                                 __global const TileSplat* splat) {
  const float cut2 = cut_radius(splat->radius) * cut_radius(splat->radius);
  PATCH pixel = lanes;
  for (int k = 0; k < TILE_HEIGHT; k += PATCH_WIDTH, pixel += (float)PATCH_WIDTH) {
    const PATCH d = (pixel + FIRST_Y) - splat->y - LOW_Y(*splat);
    store_patch(cut2 - d * d, waiting->limits + (number * TILE_HEIGHT + (uint)k));
  }
  waiting->x[number] = splat->x + LOW_X(*splat);
  waiting->y[number] = splat->y + LOW_Y(*splat);
  waiting->squeeze[number] = cut_radius(splat->radius) / cut_radius(RADIUS_X(*splat));
}
#else
#define fill_limits_of_tile(waiting, number, lanes, splat)
#endif

// Sets a splat's bit in the words of those of `count` patches that show some of its pixels.
INLINED void set_bits(uint* words, int count, int2 pixels, int pixels_of_patch, uint bit) {
  for (int i = 0; i < count; ++i) {
    const int begin = i * pixels_of_patch;
    words[i] |= pixels.y >= begin && pixels.x < begin + pixels_of_patch ? bit : 0u;
  }
}

// A call whose argument tells the compiler that it may use registers of sixteen floats, from which
// it keeps away otherwise.
__attribute__((noinline)) static void put_to_waiting(WideSplats* waiting, int2 rows, int2 columns,
                                                     PATCH lanes, __global const TileSplat* splat,
                                                     float mean_sigma) {
  const uint number = waiting->count;
  waiting->count = number + 1u;
  fill_axis_of_tile(waiting->across + number * TILE_WIDTH, TILE_WIDTH, columns, FIRST_X, splat->x,
                    LOW_X(*splat), SIGMA_X(*splat), mean_sigma, lanes);
  fill_axis_of_tile(waiting->along + number * TILE_HEIGHT, TILE_HEIGHT, rows, FIRST_Y, splat->y,
                    LOW_Y(*splat), splat->sigma, mean_sigma, lanes);
  fill_limits_of_tile(waiting, number, lanes, splat);
  waiting->summed[number * SUMMED] = splat->summed[0];
  waiting->summed[number * SUMMED + 1] = splat->summed[1];
  waiting->summed[number * SUMMED + 2] = splat->summed[2];
  set_bits(waiting->of_columns, TILE_WIDTH / PATCH_WIDTH, columns, PATCH_WIDTH, 1u << number);
  set_bits(waiting->of_rows, TILE_HEIGHT / PATCH_HEIGHT, rows, PATCH_HEIGHT, 1u << number);
}

typedef struct PatchRow {
  PATCH first, second, third;  // sums
} PatchRow;

INLINED PatchRow load_patch_row(const float* pixel) {
  PatchRow row;
  row.first = load_patch(pixel);
  row.second = load_patch(pixel + TILE_PIXELS);
  row.third = load_patch(pixel + 2 * TILE_PIXELS);
  return row;
}

INLINED void store_patch_row(const PatchRow row, float* pixel) {
  store_patch(row.first, pixel);
  store_patch(row.second, pixel + TILE_PIXELS);
  store_patch(row.third, pixel + 2 * TILE_PIXELS);
}

// A splat of those that wait, in the columns of a patch.
typedef struct PatchSplat {
  PATCH across;
  float first, second, third;  // what is summed
  const float* along;
#ifdef CUT_BY_ROWS
  PATCH dx;
  const float* limits;
  float dy, squeeze;  // of the first row
#endif
} PatchSplat;

INLINED PatchSplat splat_of_patch(const WideSplats* waiting, uint k, int x, int y, PATCH lanes) {
  PatchSplat splat;
  splat.across = load_patch(waiting->across + k * TILE_WIDTH + x);
  splat.along = waiting->along + (k * TILE_HEIGHT + y);
  splat.first = waiting->summed[k * SUMMED];
  splat.second = waiting->summed[k * SUMMED + 1];
  splat.third = waiting->summed[k * SUMMED + 2];
#ifdef CUT_BY_ROWS
  splat.dx = ((float)x + FIRST_X + lanes) - waiting->x[k];
  splat.limits = waiting->limits + (k * TILE_HEIGHT + y);
  splat.dy = (float)y + FIRST_Y - waiting->y[k];
  splat.squeeze = waiting->squeeze[k];
#endif
  return splat;
}

INLINED PatchRow add_to_row(PatchRow row, const PatchSplat splat, int k) {
  const PATCH shape = cut_shape_of_patch(splat.across * splat.along[k], splat.dx,
                                         splat.dy + (float)k, splat.limits[k], splat.squeeze);
  row.first += shape * splat.first;
  row.second += shape * splat.second;
  row.third += shape * splat.third;
  return row;
}

// Those of `splats`, of which there are some, to the patch from (x, y) on. Its rows are written
// out, since compilers keep arrays in memory.
INLINED void add_to_patch(float* tile, int x, int y, uint splats, const WideSplats* waiting,
                          PATCH lanes) {
  float* pixel = tile + y * ROW + x;
  PatchRow row0 = load_patch_row(pixel), row1 = load_patch_row(pixel + ROW);
  PatchRow row2 = load_patch_row(pixel + 2 * ROW), row3 = load_patch_row(pixel + 3 * ROW);
#if PATCH_HEIGHT == 8
  PatchRow row4 = load_patch_row(pixel + 4 * ROW), row5 = load_patch_row(pixel + 5 * ROW);
  PatchRow row6 = load_patch_row(pixel + 6 * ROW), row7 = load_patch_row(pixel + 7 * ROW);
#endif
  for (; splats != 0; splats &= splats - 1u) {
    const uint k = popcount(~splats & (splats - 1u));
    const PatchSplat splat = splat_of_patch(waiting, k, x, y, lanes);
    row0 = add_to_row(row0, splat, 0);
    row1 = add_to_row(row1, splat, 1);
    row2 = add_to_row(row2, splat, 2);
    row3 = add_to_row(row3, splat, 3);
#if PATCH_HEIGHT == 8
    row4 = add_to_row(row4, splat, 4);
    row5 = add_to_row(row5, splat, 5);
    row6 = add_to_row(row6, splat, 6);
    row7 = add_to_row(row7, splat, 7);
#endif
  }
  store_patch_row(row0, pixel);
  store_patch_row(row1, pixel + ROW);
  store_patch_row(row2, pixel + 2 * ROW);
  store_patch_row(row3, pixel + 3 * ROW);
#if PATCH_HEIGHT == 8
  store_patch_row(row4, pixel + 4 * ROW);
  store_patch_row(row5, pixel + 5 * ROW);
  store_patch_row(row6, pixel + 6 * ROW);
  store_patch_row(row7, pixel + 7 * ROW);
#endif
}

// A call, as above.
__attribute__((noinline)) static void add_wide_splats(float* tile, WideSplats* waiting,
                                                      PATCH lanes) {
  for (int y = 0; y < TILE_HEIGHT; y += PATCH_HEIGHT) {
    for (int x = 0; x < TILE_WIDTH; x += PATCH_WIDTH) {
      const uint splats = waiting->of_columns[x / PATCH_WIDTH] & waiting->of_rows[y / PATCH_HEIGHT];
      if (splats != 0) add_to_patch(tile, x, y, splats, waiting, lanes);
    }
  }
  clear_waiting(waiting);
}

// Adds those that wait to the tile.
static inline void add_waiting(float* tile, WideSplats* waiting) {
  if (waiting->count > 0) add_wide_splats(tile, waiting, PATCH_LANES);
}

// Lets a splat wait if it is one that does, and adds them when there is no room for more.
static inline int let_wait(float* tile, WideSplats* waiting, int2 rows, int2 columns,
                           __global const TileSplat* splat, float mean_sigma) {
  if (!waits_for_others(rows, columns, splat)) return 0;
  put_to_waiting(waiting, rows, columns, PATCH_LANES, splat, mean_sigma);
  if (waiting->count == MOST_WIDE_SPLATS) add_waiting(tile, waiting);
  return 1;
}
#else
// None waits.
typedef struct WideSplats {
  uint count;
} WideSplats;
#define clear_waiting(waiting) ((waiting)->count = 0)
#define add_waiting(tile, waiting)
#define let_wait(tile, waiting, rows, columns, splat, mean_sigma) 0
#endif
