// Splats whose shapes along the axes of a tile are worked out patch by patch (waiting.cl): only
// along those that they reach into.
#include "kernels/bin/bin.h"
#include "kernels/common/common.cl"
#include "kernels/common/ellipse.h"
#include "kernels/common/lanes.cl"
#include "kernels/composite/gaussian.cl"
#include "kernels/composite/patch.cl"
#include "kernels/composite/pixel_range.cl"
#include "kernels/composite/rows.cl"
#include "kernels/composite/shape.cl"

// Which patches of a tile its splats reach into.

#define PATCH_COLUMNS (TILE_WIDTH / PATCH_WIDTH)
#define PATCH_ROWS (TILE_HEIGHT / PATCH_HEIGHT)

// Only a part of the patches of a disc's square are the disc's.
#if CUT_BY_ROWS
// Columns of patches and words of splats are taken in eights and whole words.
REQUIRE(columns_in_eights, PATCH_COLUMNS <= 8 && MOST_SHAPES % 32 == 0);

// Bits of 32 splats in each word; words of eight rows are together.
#define WORDS_OF_SPLATS (MOST_SHAPES / 32)
#define ROWS_OF_WORDS ((PATCH_ROWS + 7) / 8 * 8)
typedef struct PatchReach {
  uint touched[WORDS_OF_SPLATS][PATCH_COLUMNS][ROWS_OF_WORDS] __attribute__((aligned(64)));
} PatchReach;

static inline void clear_reach(PatchReach* reach) {
  uint8* const words = (uint8*)reach;
  for (uint i = 0; i < sizeof(PatchReach) / sizeof(uint8); ++i)
    words[i] = (uint8)(0u);
}

// The pixel that holds the center of a splat keeps its light, however far its own center is.
#if SAMPLING_MEAN
#define BESIDE_PIXEL 0.5f
#else
#define BESIDE_PIXEL 0.0f
#endif

// How near the nearest of some pixels is to a splat's center, from how far the first and the last
// of them are.
#define NEAREST_OF(first, last) max(max(first, -(last)) - BESIDE_PIXEL, 0.0f)

// Sets the bit of splat `number` of these axes, cut at this radius, squared. Squares of distances
// are tested as those of pixels are, so that no pixel that is drawn is missed.
INLINED void put_reach(PatchReach* reach, uint number, const AxisOfSplats* x, const AxisOfSplats* y,
                       float cut2, float squeeze) {
  const float8 each = (float8)(0, 1, 2, 3, 4, 5, 6, 7);
  const float8 left = each * (float)PATCH_WIDTH + FIRST_X;
  const float8 near_x = NEAREST_OF(DISTANCE_ALONG(x, number, left),
                                   DISTANCE_ALONG(x, number, left + (float)(PATCH_WIDTH - 1)));
  float squares[8];
  store_eight(SQUEEZED(near_x) * SQUEEZED(near_x), squares);
  const uint word = number / 32;
  const uint8 bit = (uint8)(1u << number % 32);
  for (int row = 0; row < ROWS_OF_WORDS; row += 8) {
    const float8 top = (each + (float)row) * (float)PATCH_HEIGHT + FIRST_Y;
    const float8 near_y = NEAREST_OF(DISTANCE_ALONG(y, number, top),
                                     DISTANCE_ALONG(y, number, top + (float)(PATCH_HEIGHT - 1)));
    const float8 limits = cut2 - near_y * near_y;
#pragma unroll
    for (int column = 0; column < PATCH_COLUMNS; ++column)
      *(uint8*)(reach->touched[word][column] + row) |= as_uint8(squares[column] <= limits) & bit;
  }
}

// Those that touch a patch.
INLINED ShapeBits splats_of_patch(const PatchReach* reach, int column, int row) {
  const ShapeBits first = reach->touched[0][column][row];
  if (WORDS_OF_SPLATS == 1) return first;
  const int last = WORDS_OF_SPLATS - 1;
  return first | (ShapeBits)reach->touched[last][column][row] << 32 * last;
}

INLINED ShapeBits splats_of_column(const PatchReach* reach, int column) {
  ShapeBits splats = 0;
  for (int row = 0; row < PATCH_ROWS; ++row)
    splats |= splats_of_patch(reach, column, row);
  return splats;
}
INLINED ShapeBits splats_of_row(const PatchReach* reach, int row) {
  ShapeBits splats = 0;
  for (int column = 0; column < PATCH_COLUMNS; ++column)
    splats |= splats_of_patch(reach, column, row);
  return splats;
}
#else
typedef struct PatchReach {
  ShapeBits of_columns[PATCH_COLUMNS], of_rows[PATCH_ROWS];
} PatchReach;

static inline void clear_reach(PatchReach* reach) {
  for (int i = 0; i < PATCH_COLUMNS; ++i)
    reach->of_columns[i] = 0;
  for (int i = 0; i < PATCH_ROWS; ++i)
    reach->of_rows[i] = 0;
}

// Sets a splat's bit in the words of those of `count` patches that show some of its pixels.
INLINED void set_bits(ShapeBits* words, int count, int2 pixels, int pixels_of_patch,
                      ShapeBits bit) {
  for (int i = 0; i < count; ++i) {
    const int begin = i * pixels_of_patch;
    words[i] |= pixels.y >= begin && pixels.x < begin + pixels_of_patch ? bit : (ShapeBits)0;
  }
}

INLINED ShapeBits splats_of_patch(const PatchReach* reach, int column, int row) {
  return reach->of_columns[column] & reach->of_rows[row];
}
INLINED ShapeBits splats_of_column(const PatchReach* reach, int column) {
  return reach->of_columns[column];
}
INLINED ShapeBits splats_of_row(const PatchReach* reach, int row) {
  return reach->of_rows[row];
}
#endif

typedef struct PatchShapes {
  AxisOfSplats x, y;
  float cut2[MOST_SHAPES], squeeze[MOST_SHAPES];  // where rows are cut
  float light[MOST_SHAPES * PLANES];              // what is summed, or E and A
  PatchReach reach;
} PatchShapes;

// Rows of a tile, one splat's behind the other's.
#define ALL_ROWS (MOST_SHAPES * TILE_HEIGHT)

// Of one splat behind the other, zero beside their squares where no limits cut them: the shape
// along the columns of one patch, and along all rows of the tile.
typedef struct PatchValues {
  float along[ALL_ROWS];
  float across[MOST_SHAPES * PATCH_WIDTH];
  float most_across[MOST_SHAPES];
  float squares[MOST_SHAPES * PATCH_WIDTH];  // of distances along columns, where rows are cut
  float limits[ALL_ROWS];                    // as fill_limits() has them
} __attribute__((aligned(64))) PatchValues;

// Limits cut more than the square.
INLINED PATCH within_square(PATCH shape, PATCH pixels, const AxisOfSplats* axis, uint k) {
  if (CUT_BY_ROWS) return shape;
  return select(shape, (PATCH)(0.0f), (pixels < axis->first[k]) | (pixels > axis->last[k]));
}

// The shape of splat k along an axis, at these pixels of the tile, `d` from its center.
INLINED PATCH center_values_along(const AxisOfSplats* axis, uint k, PATCH pixels, PATCH d) {
  return within_square(exp2_negative(d * d * axis->factor[k]), pixels, axis, k);
}
INLINED PATCH means_along(const AxisOfSplats* axis, uint k, PATCH pixels, PATCH d) {
  const float factor = axis->factor[k];
  const PATCH mean = error_function((d + 0.5f) * factor) - error_function((d - 0.5f) * factor);
  return within_square(mean * (PIXEL_MEAN_SCALE * axis->sigma[k]), pixels, axis, k);
}

// What limits are held against: the square of the distance along columns, as a disc has it.
INLINED PATCH square_of_disc(PATCH d, float squeeze) {
  return SQUEEZED(d) * SQUEEZED(d);
}

// The most of the shape in the columns of a patch from x on: in one of the outer ones, or between
// them.
INLINED float most_across(const PatchShapes* shapes, uint k, int x, const float* across) {
  const float first = (float)x + FIRST_X, last = first + (float)(PATCH_WIDTH - 1);
  const float place = shapes->x.place[k];
  if (place >= first && place <= last) return 1.0f;
  return across[0] > across[PATCH_WIDTH - 1] ? across[0] : across[PATCH_WIDTH - 1];
}

// Center values and means have loops of their own, whose constants stay in registers.
#define EACH_ACROSS(chosen, shape_along)                                                       \
  for (ShapeBits left = (chosen); left != 0; left = without_first(left)) {                     \
    const uint k = first_of(left), at = k * PATCH_WIDTH;                                       \
    const PATCH d = DISTANCE_ALONG(&shapes->x, k, centers);                                    \
    store_patch(shape_along(&shapes->x, k, pixels, d), values->across + at);                   \
    values->most_across[k] = most_across(shapes, k, x, values->across + at);                   \
    if (CUT_BY_ROWS) store_patch(square_of_disc(d, shapes->squeeze[k]), values->squares + at); \
  }
INLINED void fill_across(const PatchShapes* shapes, ShapeBits splats, int x, PATCH lanes,
                         PatchValues* values) {
  const PATCH pixels = (float)x + lanes, centers = pixels + FIRST_X;
  EACH_ACROSS(splats & ~shapes->x.means, center_values_along)
  EACH_ACROSS(splats & shapes->x.means, means_along)
}

// Of as many rows from `y` on as a register holds.
#define EACH_ALONG(chosen, shape_along)                                         \
  for (ShapeBits left = (chosen); left != 0; left = without_first(left)) {      \
    const uint k = first_of(left), at = k * TILE_HEIGHT + (uint)y;              \
    const PATCH d = DISTANCE_ALONG(&shapes->y, k, centers);                     \
    store_patch(shape_along(&shapes->y, k, pixels, d), values->along + at);     \
    if (CUT_BY_ROWS) store_patch(shapes->cut2[k] - d * d, values->limits + at); \
  }
INLINED void fill_along(const PatchShapes* shapes, ShapeBits splats, int y, PATCH lanes,
                        PatchValues* values) {
  const PATCH pixels = (float)y + lanes, centers = pixels + FIRST_Y;
  EACH_ALONG(splats & ~shapes->y.means, center_values_along)
  EACH_ALONG(splats & shapes->y.means, means_along)
}

// Written out: compilers leave loops as they are.
INLINED void put_light(float* light, __global const TileSplat* splat) {
#if LIGHT_ORDERED
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

// What squares of distances are multiplied by for an exponent of 2, or, of means, distances.
INLINED float factor_of(float sigma, float mean_sigma) {
  return sigma >= mean_sigma ? -inverse_of(sigma) : 1.0f / sigma;
}

INLINED void put_axis(AxisOfSplats* axis, uint number, float place, float low, float sigma,
                      float factor, int is_mean, int2 pixels) {
  axis->place[number] = place;
#if FINE_PLACES
  axis->low[number] = low;
#endif
  axis->sigma[number] = sigma;
  axis->factor[number] = factor;
  axis->means |= (ShapeBits)is_mean << number;
  axis->first[number] = (float)pixels.x;
  axis->last[number] = (float)pixels.y;
}

// The splat of this number, which touches `rows` and `columns` of the tile.
INLINED void put_splat(PatchShapes* shapes, uint number, int2 rows, int2 columns,
                       __global const TileSplat* splat, float mean_sigma) {
  const float sigma = splat->sigma, factor = factor_of(sigma, mean_sigma);
  const int is_mean = sigma < mean_sigma;
  const float sigma_x = SIGMA_X(*splat);
  const float factor_x = ELLIPSES ? factor_of(sigma_x, mean_sigma) : factor;
  const int is_mean_x = sigma_x < mean_sigma;
  put_axis(&shapes->x, number, splat->x, LOW_X(*splat), sigma_x, factor_x, is_mean_x, columns);
  put_axis(&shapes->y, number, splat->y, LOW_Y(*splat), sigma, factor, is_mean, rows);
#if CUT_BY_ROWS
  shapes->cut2[number] = cut_radius(splat->radius) * cut_radius(splat->radius);
  shapes->squeeze[number] =
      ELLIPSES ? cut_radius(splat->radius) / cut_radius(RADIUS_X(*splat)) : 1.0f;
#endif
  put_light(shapes->light + number * PLANES, splat);
#if CUT_BY_ROWS
  put_reach(&shapes->reach, number, &shapes->x, &shapes->y, shapes->cut2[number],
            shapes->squeeze[number]);
#else
  set_bits(shapes->reach.of_columns, PATCH_COLUMNS, columns, PATCH_WIDTH, (ShapeBits)1 << number);
  set_bits(shapes->reach.of_rows, PATCH_ROWS, rows, PATCH_HEIGHT, (ShapeBits)1 << number);
#endif
}
