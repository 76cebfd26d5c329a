// Splats whose shapes along the axes of a tile are worked out patch by patch (waiting.cl): only
// along those that they reach into.
#include "kernels/bin/bin.h"
#include "kernels/common/common.cl"
#include "kernels/common/ellipse.h"
#include "kernels/common/lanes.cl"
#include "kernels/composite/gaussian.cl"
#include "kernels/composite/patch.cl"
#include "kernels/composite/patch_reach.cl"
#include "kernels/composite/pixel_range.cl"
#include "kernels/composite/rows.cl"
#include "kernels/composite/shape.cl"

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
