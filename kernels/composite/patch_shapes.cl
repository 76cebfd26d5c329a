// Shapes of some splats along the axes of a tile, for patches of it (patches.cl).

// As wide as registers are, and with as many rows as leave some of them for a splat.
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

#ifndef FACE_OF_CUBE
#if PLANES == 6
#define PATCH_HEIGHT (PATCH_WIDTH / 4)
#else
#define PATCH_HEIGHT (PATCH_WIDTH / 2)
#endif
#if TILE_WIDTH % PATCH_WIDTH != 0 || TILE_HEIGHT % PATCH_WIDTH != 0
#error "a tile is not made of whole patches"
#endif

// A bit of a word for each.
#define MOST_SHAPES 32

// One splat behind the other, zero beside their squares where no limits cut them.
typedef struct PatchShapes {
  float across[MOST_SHAPES * TILE_WIDTH], along[MOST_SHAPES * TILE_HEIGHT];
#ifdef CUT_BY_ROWS
  float limits[MOST_SHAPES * TILE_HEIGHT];  // as fill_limits() has them
  float x[MOST_SHAPES], y[MOST_SHAPES], squeeze[MOST_SHAPES];
#endif
  float light[MOST_SHAPES * PLANES];          // what is summed, or E and A
  uint of_columns[TILE_WIDTH / PATCH_WIDTH];  // bits of the splats that reach into patches of
  uint of_rows[TILE_HEIGHT / PATCH_HEIGHT];   // these columns, and of these rows
} __attribute__((aligned(64))) PatchShapes;

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

// The shape along an axis of a tile of `size` pixels: as many as hold the square, or, of a cut
// kernel, whose squares differ more, all, since no processor foresees how many a splat has.
INLINED void fill_axis_of_tile(float* values, int size, const Axis axis, float mean_sigma,
                               PATCH lanes) {
#ifdef CUT_BY_ROWS
  const int begin = 0, end = size;
#else
  const int count = (axis.square.y - axis.square.x + PATCH_WIDTH) & ~(PATCH_WIDTH - 1);
  const int begin = min(axis.square.x, size - count), end = begin + count;
  for (int k = 0; k < size; k += PATCH_WIDTH)
    store_patch((PATCH)(0.0f), values + k);
#endif
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
INLINED void fill_limits_of_tile(PatchShapes* shapes, uint number, PATCH lanes,
                                 __global const TileSplat* splat) {
  const float cut2 = cut_radius(splat->radius) * cut_radius(splat->radius);
  PATCH pixel = lanes;
  for (int k = 0; k < TILE_HEIGHT; k += PATCH_WIDTH, pixel += (float)PATCH_WIDTH) {
    const PATCH d = (pixel + FIRST_Y) - splat->y - LOW_Y(*splat);
    store_patch(cut2 - d * d, shapes->limits + (number * TILE_HEIGHT + (uint)k));
  }
  shapes->x[number] = splat->x + LOW_X(*splat);
  shapes->y[number] = splat->y + LOW_Y(*splat);
  shapes->squeeze[number] = cut_radius(splat->radius) / cut_radius(RADIUS_X(*splat));
}
#else
#define fill_limits_of_tile(shapes, number, lanes, splat)
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

static inline void clear_shapes(PatchShapes* shapes) {
  for (int i = 0; i < TILE_WIDTH / PATCH_WIDTH; ++i)
    shapes->of_columns[i] = 0;
  for (int i = 0; i < TILE_HEIGHT / PATCH_HEIGHT; ++i)
    shapes->of_rows[i] = 0;
}

// The splat of this number, which touches `rows` and `columns` of the tile. A call whose argument
// tells the compiler that it may use registers of sixteen floats (lanes.cl).
__attribute__((noinline)) static void put_shape(PatchShapes* shapes, uint number, int2 rows,
                                                int2 columns, __global const TileSplat* splat,
                                                float mean_sigma, PATCH lanes) {
  const Axis along_x = {FIRST_X, splat->x, LOW_X(*splat), SIGMA_X(*splat), columns};
  const Axis along_y = {FIRST_Y, splat->y, LOW_Y(*splat), splat->sigma, rows};
  fill_axis_of_tile(shapes->across + number * TILE_WIDTH, TILE_WIDTH, along_x, mean_sigma, lanes);
  fill_axis_of_tile(shapes->along + number * TILE_HEIGHT, TILE_HEIGHT, along_y, mean_sigma, lanes);
  fill_limits_of_tile(shapes, number, lanes, splat);
  put_light(shapes->light + number * PLANES, splat);
  set_bits(shapes->of_columns, TILE_WIDTH / PATCH_WIDTH, columns, PATCH_WIDTH, 1u << number);
  set_bits(shapes->of_rows, TILE_HEIGHT / PATCH_HEIGHT, rows, PATCH_HEIGHT, 1u << number);
}
#endif
