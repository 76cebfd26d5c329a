// Discs of sums, of a kernel that is cut and taken at pixels' centers, up to sixteen pixels wide:
// what does not differ from pixel to pixel is worked out for eight entries at once, and no loop
// over columns is left. Wider ones wait (waiting.cl).
#include "kernels/bin/bin.h"
#include "kernels/bin/entry_lanes.cl"
#include "kernels/common/common.cl"
#include "kernels/common/lanes.cl"
#include "kernels/composite/entry_windows.cl"
#include "kernels/composite/gaussian.cl"
#include "kernels/composite/patch.cl"
#include "kernels/composite/rows.cl"

#if !defined(LIGHT_ORDERED) && defined(CUT_BY_ROWS) && !defined(SAMPLING_MEAN) && \
    !defined(ELLIPSES) && !defined(FINE_PLACES) && SUMMED == 3
#define NARROW_DISCS
// Columns of the smallest, whose axes fit one eight, and rows of most of these.
#define DOT 4
#define ROWS_OF_DOT 2

// Kinds of a group (entry_group.cl), by their columns.
#define SMALLEST DOT
#define SMALL 8
typedef struct NarrowDiscs {
  int columns[ROOM_OF_ENTRIES];                // of the window: DOT, 8, 16, or 0 of other splats
  int x[ROOM_OF_ENTRIES], y[ROOM_OF_ENTRIES];  // its first pixel
  int rows[ROOM_OF_ENTRIES];
  float across[ROOM_OF_ENTRIES], along[ROOM_OF_ENTRIES];  // of its center from the splat's
  float factor[ROOM_OF_ENTRIES];  // of squares of distances, for an exponent of 2
  float cut2[ROOM_OF_ENTRIES];
} NarrowDiscs;

// Of eight entries, numbers `at` and on; returns their columns.
INLINED INTEGER find_narrow_discs(const EntryLanes lanes, uint at, const EntryWindows* windows,
                                  NarrowDiscs* discs) {
  const VALUE sigma = lanes.sigma, radius = lanes.radius;
  const INTEGER first_column = load_eight_integers(windows->first_column + at);
  const INTEGER first_row = load_eight_integers(windows->first_row + at);
  const INTEGER last_row = load_eight_integers(windows->last_row + at);
  const INTEGER width = load_eight_integers(windows->last_column + at) - first_column + 1;
  const INTEGER widest = max(width, last_row - first_row + 1);
  const INTEGER fits = (widest <= 16) & (sigma > 0.0f);
  const INTEGER is_dot = widest <= DOT;
  const INTEGER eights = select((INTEGER)(16), (INTEGER)(8), width <= 8);
  const INTEGER columns = select(eights, (INTEGER)(DOT), is_dot);
  const INTEGER x = min(first_column, TILE_WIDTH - columns);
  // All rows of a dot are drawn, whether it touches them or not.
  const INTEGER y = select(first_row, min(first_row, TILE_HEIGHT - DOT), is_dot);
  STORE(columns & fits, discs->columns + at);
  STORE(x, discs->x + at);
  STORE(y, discs->y + at);
  STORE(last_row - y + 1, discs->rows + at);
  STORE(TO_VALUE(x) + FIRST_X - lanes.x, discs->across + at);
  STORE(TO_VALUE(y) + FIRST_Y - lanes.y, discs->along + at);
  STORE(-1.44269504f / (sigma * sigma), discs->factor + at);
  STORE(radius * radius, discs->cut2 + at);
  return columns & fits;
}

// The rows of a disc: the shape along them, and the largest squares of distances along columns.
typedef struct DiscRows {
  float along[16], limits[16];
} DiscRows;

INLINED float* first_pixel_of_disc(float* tile, const NarrowDiscs* discs, int i) {
  return tile + discs->y[i] * ROW + discs->x[i];
}

#define LIGHT_OF(VECTOR)                                                               \
  const VECTOR light0 = across * splat->summed[0], light1 = across * splat->summed[1], \
               light2 = across * splat->summed[2]

#define ADD_DOT(c) \
  vstore4(vload4(0, pixel + c * TILE_PIXELS) + shape * light##c, 0, pixel + c * TILE_PIXELS);
#define ADD_ROWS_OF_DOT(first, end)                                                       \
  _Pragma("unroll") for (int k = first; k < end; ++k, pixel += ROW) {                     \
    const float4 shape = select((float4)(along[k]), (float4)(0.0f), squares > limits[k]); \
    ADD_DOT(0) ADD_DOT(1) ADD_DOT(2)                                                      \
  }
INLINED void add_dot(float* tile, const NarrowDiscs* discs, int i,
                     __global const TileSplat* splat) {
  float* pixel = first_pixel_of_disc(tile, discs, i);
  const float8 first = (float8)((float4)(discs->across[i]), (float4)(discs->along[i]));
  const float8 distance = first + (float8)(0, 1, 2, 3, 0, 1, 2, 3), square = distance * distance;
  const float8 shapes = exp2_negative(square * discs->factor[i]);
  float along[DOT], limits[DOT];
  vstore4(shapes.hi, 0, along);
  vstore4(discs->cut2[i] - square.hi, 0, limits);
  const float4 across = shapes.lo, squares = square.lo;
  LIGHT_OF(float4);
  ADD_ROWS_OF_DOT(0, ROWS_OF_DOT)
  if (discs->rows[i] <= ROWS_OF_DOT) return;
  ADD_ROWS_OF_DOT(ROWS_OF_DOT, DOT)
}

// Eight columns of a disc, the first one's center this far from the splat's.
INLINED void add_eight_columns(float* pixel, float first, float factor, const DiscRows* of_disc,
                               int rows, __global const TileSplat* splat) {
  const float8 distance = first + (float8)(0, 1, 2, 3, 4, 5, 6, 7), squares = distance * distance;
  const float8 across = exp2_negative(squares * factor);
  SUMMED_CHANNELS
  for (int k = 0; k < rows; ++k, pixel += ROW) {
    const float8 shape =
        select((float8)(of_disc->along[k]), (float8)(0.0f), squares > of_disc->limits[k]);
    ADD_CHANNELS
  }
}

#ifdef ROWS_OF_16
INLINED void fill_rows_of_disc(float first, float factor, float cut2, int rows, DiscRows* of_disc) {
  const float16 distance = first + PATCH_LANES, square = distance * distance;
  store_patch(exp2_negative(square * factor), of_disc->along);
  store_patch(cut2 - square, of_disc->limits);
}

#define ADD_SIXTEEN(c)                                                    \
  {                                                                       \
    float* const to = pixel + c * TILE_PIXELS;                            \
    const float16 before = load_patch(to);                                \
    store_patch(select(before, before + light##c * along, is_drawn), to); \
  }
INLINED void add_sixteen_columns(float* pixel, float first, float factor, const DiscRows* of_disc,
                                 int rows, __global const TileSplat* splat) {
  const float16 distance = first + PATCH_LANES, squares = distance * distance;
  const float16 across = exp2_negative(squares * factor);
  LIGHT_OF(float16);
  for (int k = 0; k < rows; ++k, pixel += ROW) {
    const float16 along = of_disc->along[k];
    const int16 is_drawn = squares <= of_disc->limits[k];
    ADD_SIXTEEN(0) ADD_SIXTEEN(1) ADD_SIXTEEN(2)
  }
}
#else
INLINED void fill_rows_of_disc(float first, float factor, float cut2, int rows, DiscRows* of_disc) {
  const float8 ramp = (float8)(0, 1, 2, 3, 4, 5, 6, 7);
#pragma unroll
  for (int k = 0; k < 16; k += 8) {
    if (k >= rows) break;
    const float8 distance = first + (ramp + (float)k), square = distance * distance;
    store_eight(exp2_negative(square * factor), of_disc->along + k);
    store_eight(cut2 - square, of_disc->limits + k);
  }
}
INLINED void add_sixteen_columns(float* pixel, float first, float factor, const DiscRows* of_disc,
                                 int rows, __global const TileSplat* splat) {
  add_eight_columns(pixel, first, factor, of_disc, rows, splat);
  add_eight_columns(pixel + 8, first + 8.0f, factor, of_disc, rows, splat);
}
#endif

// Of eight columns, or sixteen.
INLINED void add_disc(float* tile, const NarrowDiscs* discs, int i, int columns,
                      __global const TileSplat* splat) {
  float* const pixel = first_pixel_of_disc(tile, discs, i);
  const float factor = discs->factor[i], across = discs->across[i];
  const int rows = discs->rows[i];
  DiscRows of_disc;
  fill_rows_of_disc(discs->along[i], factor, discs->cut2[i], rows, &of_disc);
  if (columns == 8)
    add_eight_columns(pixel, across, factor, &of_disc, rows, splat);
  else
    add_sixteen_columns(pixel, across, factor, &of_disc, rows, splat);
}
#endif
