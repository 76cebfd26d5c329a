// Splats that wait until there are some, and then a patch of the tile stays in registers while all
// of them are added to it, one after the other. Row by row each splat would load and store pixels
// that the one before has just stored, and a processor waits for that.
#ifndef FACE_OF_CUBE
#define SPLATS_WAIT

// As many rows as leave registers for a splat.
#ifdef ROWS_OF_16
#ifdef __clang__
typedef float16 __attribute__((aligned(4))) Sixteen;
#define load_patch(p) (*(const Sixteen*)(p))
#define store_patch(v, p) (*(Sixteen*)(p) = (v))
#else
#define load_patch(p) vload16(0, p)
#define store_patch(v, p) vstore16(v, 0, p)
#endif
#ifdef CUT_BY_ROWS
DEFINE_CUT_SHAPE(cut_shape_of_patch, float16, int16)
#else
#define cut_shape_of_patch cut_shape
#endif
#define PATCH float16
#define PATCH_WIDTH 16
#define PATCH_LANES (float16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)
#else
#define PATCH float8
#define PATCH_WIDTH 8
#define PATCH_LANES (float8)(0, 1, 2, 3, 4, 5, 6, 7)
#define load_patch load_eight
#define store_patch store_eight
#define cut_shape_of_patch cut_shape
#endif
#if PLANES == 6
#define PATCH_HEIGHT (PATCH_WIDTH / 4)
#else
#define PATCH_HEIGHT (PATCH_WIDTH / 2)
#endif
#if TILE_WIDTH % PATCH_WIDTH != 0 || TILE_HEIGHT % PATCH_WIDTH != 0
#error "a tile is not made of whole patches"
#endif

// A bit of a word for each.
#define MOST_WAITING_SPLATS 32

// Splats that wait, one behind the other: their shape along both axes, zero beside their square
// where no limits cut it.
typedef struct WaitingSplats {
  float across[MOST_WAITING_SPLATS * TILE_WIDTH], along[MOST_WAITING_SPLATS * TILE_HEIGHT];
#ifdef CUT_BY_ROWS
  float limits[MOST_WAITING_SPLATS * TILE_HEIGHT];  // as fill_limits() has them
  float x[MOST_WAITING_SPLATS], y[MOST_WAITING_SPLATS], squeeze[MOST_WAITING_SPLATS];
#endif
  float light[MOST_WAITING_SPLATS * PLANES];  // what is summed, or E and A
#ifdef LIGHT_ORDERED
  uint of_more_terms, of_three_terms;  // bits of those whose layers take more than one of them
#endif
  uint of_columns[TILE_WIDTH / PATCH_WIDTH];  // bits of the splats that reach into patches of
  uint of_rows[TILE_HEIGHT / PATCH_HEIGHT];   // these columns, and of these rows
  uint count;
} __attribute__((aligned(64))) WaitingSplats;

static inline void clear_waiting(WaitingSplats* waiting) {
  waiting->count = 0;
#ifdef LIGHT_ORDERED
  waiting->of_more_terms = waiting->of_three_terms = 0;
#endif
  for (int i = 0; i < TILE_WIDTH / PATCH_WIDTH; ++i)
    waiting->of_columns[i] = 0;
  for (int i = 0; i < TILE_HEIGHT / PATCH_HEIGHT; ++i)
    waiting->of_rows[i] = 0;
}

// Whether a splat that touches `rows` and `columns` of the tile waits: wide ones do, and in order
// all behind them. Bright ones take other formulas, and deep layers, one by one.
static inline int waits_for_others(const WaitingSplats* waiting, int2 rows, int2 columns,
                                   __global const TileSplat* splat, int form) {
  const int widest = max(columns.y - columns.x, rows.y - rows.x);
  const int is_dim = SIGMA_X(*splat) > 0.0f && splat->sigma > 0.0f;
#ifdef LIGHT_ORDERED
  return form <= BY_THREE_TERMS && is_dim && (widest >= 7 || waiting->count > 0);
#else
  return is_dim && widest >= 7;
#endif
}

// What the shape along one axis follows from: the center lies at `place` + `low`, the tile's first
// pixel at `first`; `square` is the range of pixels that are drawn.
typedef struct Axis {
  float first, place, low, sigma;
  int2 square;
} Axis;

// Limits cut more than the square.
#ifdef CUT_BY_ROWS
#define WITHIN_SQUARE(shape, pixel, axis) (shape)
#else
#define WITHIN_SQUARE(shape, pixel, axis) \
  select(shape, (PATCH)(0.0f),            \
         ((pixel) < (float)(axis).square.x) | ((pixel) > (float)(axis).square.y))
#endif

INLINED PATCH centers_along(const Axis axis, PATCH pixel, float inverse) {
  const PATCH d = (pixel + axis.first) - axis.place - axis.low;
  return WITHIN_SQUARE(gaussian(d, inverse), pixel, axis);
}
INLINED PATCH means_along(const Axis axis, PATCH pixel, float per_sigma) {
  const PATCH d = (pixel + axis.first) - axis.place - axis.low;
  const PATCH mean =
      error_function((d + 0.5f) * per_sigma) - error_function((d - 0.5f) * per_sigma);
  return WITHIN_SQUARE(mean * (PIXEL_MEAN_SCALE * axis.sigma), pixel, axis);
}

// The shape along an axis of a tile of `size` pixels, all of it, since no processor foresees which
// part a splat reaches; in wide tiles, where most splats fit into a line, of a line alone.
#define LINE_PIXELS 16
#if TILE_WIDTH > 2 * LINE_PIXELS && !defined(KERNEL_CUT)
#define CAN_FIT 1
#else
#define CAN_FIT 0
#endif
INLINED void fill_axis_of_tile(float* values, int size, const Axis axis, float mean_sigma,
                               PATCH lanes) {
  const int fits = CAN_FIT && axis.square.y - axis.square.x < LINE_PIXELS;
  const int begin = fits ? min(axis.square.x, size - LINE_PIXELS) : 0;
  const int end = fits ? begin + LINE_PIXELS : size;
  if (fits) {
    for (int k = 0; k < size; k += PATCH_WIDTH)
      store_patch((PATCH)(0.0f), values + k);
  }
  if (axis.sigma >= mean_sigma) {
    const float inverse = inverse_of(axis.sigma);
    for (int k = begin; k < end; k += PATCH_WIDTH)
      store_patch(centers_along(axis, (float)k + lanes, inverse), values + k);
  } else {
    const float per_sigma = 1.0f / axis.sigma;
    for (int k = begin; k < end; k += PATCH_WIDTH)
      store_patch(means_along(axis, (float)k + lanes, per_sigma), values + k);
  }
}

// What cuts the splat in the rows of a tile.
#ifdef CUT_BY_ROWS
INLINED void fill_limits_of_tile(WaitingSplats* waiting, uint number, PATCH lanes,
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

// Written out: compilers leave loops as they are.
INLINED void put_light(float* light, __global const TileSplat* splat) {
#ifdef LIGHT_ORDERED
  light[0] = splat->emission[0];
  light[1] = splat->emission[1];
  light[2] = splat->emission[2];
  light[3] = splat->absorption[0];
  light[4] = splat->absorption[1];
  light[5] = splat->absorption[2];
#else
  light[0] = splat->summed[0];
  light[1] = splat->summed[1];
  light[2] = splat->summed[2];
#if SUMMED == 6
  light[3] = splat->summed[3];
  light[4] = splat->summed[4];
  light[5] = splat->summed[5];
#endif
#endif
}

// A call whose argument tells the compiler that it may use registers of sixteen floats, from which
// it keeps away otherwise.
__attribute__((noinline)) static void put_to_waiting(WaitingSplats* waiting, int2 rows,
                                                     int2 columns, PATCH lanes,
                                                     __global const TileSplat* splat,
                                                     float mean_sigma, int form) {
  const uint number = waiting->count, bit = 1u << number;
  waiting->count = number + 1u;
  const Axis along_x = {FIRST_X, splat->x, LOW_X(*splat), SIGMA_X(*splat), columns};
  const Axis along_y = {FIRST_Y, splat->y, LOW_Y(*splat), splat->sigma, rows};
  fill_axis_of_tile(waiting->across + number * TILE_WIDTH, TILE_WIDTH, along_x, mean_sigma, lanes);
  fill_axis_of_tile(waiting->along + number * TILE_HEIGHT, TILE_HEIGHT, along_y, mean_sigma, lanes);
  fill_limits_of_tile(waiting, number, lanes, splat);
  put_light(waiting->light + number * PLANES, splat);
#ifdef LIGHT_ORDERED
  waiting->of_more_terms |= form > BY_ONE_TERM ? bit : 0u;
  waiting->of_three_terms |= form == BY_THREE_TERMS ? bit : 0u;
#endif
  set_bits(waiting->of_columns, TILE_WIDTH / PATCH_WIDTH, columns, PATCH_WIDTH, bit);
  set_bits(waiting->of_rows, TILE_HEIGHT / PATCH_HEIGHT, rows, PATCH_HEIGHT, bit);
}

// Light, and behind it opacities in order.
typedef struct PatchRow {
  PATCH plane0, plane1, plane2;
#if PLANES == 6
  PATCH plane3, plane4, plane5;
#endif
} PatchRow;

INLINED PatchRow load_patch_row(const float* pixel) {
  PatchRow row;
  row.plane0 = load_patch(pixel);
  row.plane1 = load_patch(pixel + TILE_PIXELS);
  row.plane2 = load_patch(pixel + 2 * TILE_PIXELS);
#if PLANES == 6
  row.plane3 = load_patch(pixel + 3 * TILE_PIXELS);
  row.plane4 = load_patch(pixel + 4 * TILE_PIXELS);
  row.plane5 = load_patch(pixel + 5 * TILE_PIXELS);
#endif
  return row;
}

INLINED void store_patch_row(const PatchRow row, float* pixel) {
  store_patch(row.plane0, pixel);
  store_patch(row.plane1, pixel + TILE_PIXELS);
  store_patch(row.plane2, pixel + 2 * TILE_PIXELS);
#if PLANES == 6
  store_patch(row.plane3, pixel + 3 * TILE_PIXELS);
  store_patch(row.plane4, pixel + 4 * TILE_PIXELS);
  store_patch(row.plane5, pixel + 5 * TILE_PIXELS);
#endif
}

// A splat of those that wait, in the columns of a patch.
typedef struct PatchSplat {
  PATCH across;
  const float* light;
  const float* along;
#ifdef CUT_BY_ROWS
  PATCH dx;
  const float* limits;
  float dy, squeeze;  // of the first row
#endif
} PatchSplat;

INLINED PatchSplat splat_of_patch(const WaitingSplats* waiting, uint k, int x, int y, PATCH lanes) {
  PatchSplat splat;
  splat.across = load_patch(waiting->across + k * TILE_WIDTH + x);
  splat.along = waiting->along + (k * TILE_HEIGHT + y);
  splat.light = waiting->light + k * PLANES;
#ifdef CUT_BY_ROWS
  splat.dx = ((float)x + FIRST_X + lanes) - waiting->x[k];
  splat.limits = waiting->limits + (k * TILE_HEIGHT + y);
  splat.dy = (float)y + FIRST_Y - waiting->y[k];
  splat.squeeze = waiting->squeeze[k];
#endif
  return splat;
}

#ifdef LIGHT_ORDERED
#define SHAPE_IN_ROW(splat, k) NOT_NEGATIVE((splat).across*(splat).along[k])
#else
#define SHAPE_IN_ROW(splat, k) ((splat).across * (splat).along[k])
#endif
INLINED PATCH shape_in_row(const PatchSplat splat, int k) {
  return cut_shape_of_patch(SHAPE_IN_ROW(splat, k), splat.dx, splat.dy + (float)k, splat.limits[k],
                            splat.squeeze);
}

#ifdef LIGHT_ORDERED
// A layer as THIN_CHANNEL() has it, of the plane of light `s` and the plane of opacity `o`.
#define PATCH_CHANNEL(s, o, COVERED)                  \
  {                                                   \
    const PATCH covered = COVERED(splat.light[o]);    \
    const PATCH u = covered - row.plane##o * covered; \
    row.plane##s += u * splat.light[s];               \
    row.plane##o += u * splat.light[o];               \
  }
#define PATCH_OF_ONE_TERM(absorption) (shape)
#define PATCH_OF_TWO_TERMS(absorption) (shape + (shape * shape) * (-0.5f * (absorption)))
#define PATCH_OF_THREE_TERMS(absorption) \
  (shape +                               \
   (shape * shape) * (shape * (0.166666667f * (absorption) * (absorption)) - 0.5f * (absorption)))
#define PATCH_CHANNELS(COVERED) \
  PATCH_CHANNEL(0, 3, COVERED) PATCH_CHANNEL(1, 4, COVERED) PATCH_CHANNEL(2, 5, COVERED)
INLINED PatchRow add_one_term(PatchRow row, const PatchSplat splat, int k) {
  const PATCH shape = shape_in_row(splat, k);
  PATCH_CHANNELS(PATCH_OF_ONE_TERM)
  return row;
}
INLINED PatchRow add_two_terms(PatchRow row, const PatchSplat splat, int k) {
  const PATCH shape = shape_in_row(splat, k);
  PATCH_CHANNELS(PATCH_OF_TWO_TERMS)
  return row;
}
INLINED PatchRow add_three_terms(PatchRow row, const PatchSplat splat, int k) {
  const PATCH shape = shape_in_row(splat, k);
  PATCH_CHANNELS(PATCH_OF_THREE_TERMS)
  return row;
}
#else
INLINED PatchRow add_to_sums(PatchRow row, const PatchSplat splat, int k) {
  const PATCH shape = shape_in_row(splat, k);
  row.plane0 += shape * splat.light[0];
  row.plane1 += shape * splat.light[1];
  row.plane2 += shape * splat.light[2];
#if PLANES == 6
  row.plane3 += shape * splat.light[3];
  row.plane4 += shape * splat.light[4];
  row.plane5 += shape * splat.light[5];
#endif
  return row;
}
#endif

// The rows of a patch, written out, since compilers keep arrays in memory.
#if PATCH_HEIGHT == 8
#define EACH_ROW(DO) DO(0) DO(1) DO(2) DO(3) DO(4) DO(5) DO(6) DO(7)
#elif PATCH_HEIGHT == 4
#define EACH_ROW(DO) DO(0) DO(1) DO(2) DO(3)
#else
#define EACH_ROW(DO) DO(0) DO(1)
#endif
#define LOAD_ROW_OF_PATCH(k) PatchRow row##k = load_patch_row(pixel + k * ROW);
#define STORE_ROW_OF_PATCH(k) store_patch_row(row##k, pixel + k * ROW);
#define ADD_TO_SUMS(k) row##k = add_to_sums(row##k, splat, k);
#define ADD_ONE_TERM(k) row##k = add_one_term(row##k, splat, k);
#define ADD_TWO_TERMS(k) row##k = add_two_terms(row##k, splat, k);
#define ADD_THREE_TERMS(k) row##k = add_three_terms(row##k, splat, k);
#define ADD_AS_FORMS_ARE                          \
  if (!(waiting->of_more_terms >> k & 1u)) {      \
    EACH_ROW(ADD_ONE_TERM)                        \
  } else if (waiting->of_three_terms >> k & 1u) { \
    EACH_ROW(ADD_THREE_TERMS)                     \
  } else {                                        \
    EACH_ROW(ADD_TWO_TERMS)                       \
  }

// Those of `splats`, of which there are some, to the patch from (x, y) on.
#define EACH_SPLAT(ROWS)                                              \
  for (; splats != 0; splats &= splats - 1u) {                        \
    const uint k = popcount(~splats & (splats - 1u));                 \
    const PatchSplat splat = splat_of_patch(waiting, k, x, y, lanes); \
    ROWS                                                              \
  }
INLINED void add_to_patch(float* tile, int x, int y, uint splats, const WaitingSplats* waiting,
                          PATCH lanes) {
  float* pixel = tile + y * ROW + x;
  EACH_ROW(LOAD_ROW_OF_PATCH)
#ifdef LIGHT_ORDERED
  if ((splats & waiting->of_more_terms) == 0) {
    EACH_SPLAT(EACH_ROW(ADD_ONE_TERM))
  } else {
    EACH_SPLAT(ADD_AS_FORMS_ARE)
  }
#else
  EACH_SPLAT(EACH_ROW(ADD_TO_SUMS))
#endif
  EACH_ROW(STORE_ROW_OF_PATCH)
}

// A call, as above.
__attribute__((noinline)) static void add_all_to_patches(float* tile, WaitingSplats* waiting,
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
static inline void add_waiting(float* tile, WaitingSplats* waiting) {
  if (waiting->count > 0) add_all_to_patches(tile, waiting, PATCH_LANES);
}

// Lets a splat wait if it is one that does, and adds those that wait when there is no room for
// more, and before one in order that does not wait.
static inline int let_wait(float* tile, WaitingSplats* waiting, int2 rows, int2 columns,
                           __global const TileSplat* splat, float mean_sigma, int form) {
  if (!waits_for_others(waiting, rows, columns, splat, form)) {
#ifdef LIGHT_ORDERED
    add_waiting(tile, waiting);
#endif
    return 0;
  }
  put_to_waiting(waiting, rows, columns, PATCH_LANES, splat, mean_sigma, form);
  if (waiting->count == MOST_WAITING_SPLATS) add_waiting(tile, waiting);
  return 1;
}
#else
// None waits.
typedef struct WaitingSplats {
  uint count;
} WaitingSplats;
#define clear_waiting(waiting) ((waiting)->count = 0)
#define add_waiting(tile, waiting)
#define let_wait(tile, waiting, rows, columns, splat, mean_sigma, form) 0
#endif
