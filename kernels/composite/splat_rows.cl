// A splat in a tile, eight pixels of a row at a time: its shape is the product of one along x and
// one along y, of which each is worked out once.
#include "kernels/bin/bin.h"
#include "kernels/common/common.cl"
#include "kernels/common/ellipse.h"
#include "kernels/common/grid.h"
#include "kernels/common/lanes.cl"
#include "kernels/composite/composite.h"
#include "kernels/composite/gaussian.cl"
#include "kernels/composite/rows.cl"
#include "kernels/composite/shape.cl"

// What all splats of a tile share.
typedef struct SplatTile {
  float mean_sigma;
} SplatTile;

static inline SplatTile splat_tile(const Grid grid, uint tile, const CompositeParameters* p) {
  SplatTile of_tile;
  of_tile.mean_sigma = grid.mean_sigma;
  return of_tile;
}

// The shape at the centers of `count` pixels, as fill_axis() has it; the inverse as for gaussian().
INLINED void fill_center_values(float* values, float first, float low, int count, float inverse) {
  const float8 begin = first + (float8)(0, 1, 2, 3, 4, 5, 6, 7) - low;
  float8 farther = (float8)(0.0f);
  for (int k = 0; k < count; k += 8, farther += 8.0f)
    store_eight(gaussian(begin + farther, inverse), values + k);
}

// fill_axis() of a bright splat.
static inline void fill_bright_axis(float* values, float first, float low, int count, float sigma) {
  const float8 ramp = (float8)(0, 1, 2, 3, 4, 5, 6, 7);
  if (sigma >= WIDE_MEAN) {
    for (int k = 0; k < count; k += 8)
      vstore8(wide_bright_mean(first + (float)k + ramp - low, sigma), 0, values + k);
    return;
  }
  const float per_sigma = 1.0f / sigma;
  for (int k = 0; k <= count; k += 8) {
    const float8 edge = (first - 0.5f + (float)k + ramp - low) * per_sigma;
    vstore8(complement_of_erf(fabs(edge)), 0, values + k);
  }
  const int end = (count + 7) & ~7;
  if (count < end) values[end] = values[end - 1];
  for (int k = 0; k < count; k += 8) {
    const float8 left = (first - 0.5f + (float)k + ramp - low) * per_sigma;
    const float8 right = (first + 0.5f + (float)k + ramp - low) * per_sigma;
    const float8 mean =
        mean_of_complements(left, vload8(0, values + k), right, vload8(0, values + k + 1));
    vstore8(mean * (PIXEL_MEAN_SCALE * sigma), 0, values + k);
  }
}

// One axis of the separable shape at `count` pixels, the first one's centre at distance
// `first` - `low`. Writes whole eights: `values` has room for 16 more than `count`.
static inline void fill_axis(float* values, float first, float low, int count, float sigma,
                             float mean_sigma) {
  const float8 ramp = (float8)(0, 1, 2, 3, 4, 5, 6, 7);
  if (sigma < 0.0f) {
    fill_bright_axis(values, first, low, count, -sigma);
    return;
  }
  if (sigma >= mean_sigma) {
    fill_center_values(values, first, low, count, inverse_of(sigma));
    return;
  }
  // Neighbouring pixels share an edge.
  const float per_sigma = 1.0f / sigma;
  for (int k = 0; k <= count; k += 8) {
    vstore8(error_function((first - 0.5f + (float)k + ramp - low) * per_sigma), 0, values + k);
  }
  // Pixels beyond `count` in its last eight are drawn, too: the very last has no far edge.
  const int end = (count + 7) & ~7;
  if (count < end) values[end] = values[end - 1];
  for (int k = 0; k < count; k += 8) {
    const float8 mean = vload8(0, values + k + 1) - vload8(0, values + k);
    vstore8(mean * (PIXEL_MEAN_SCALE * sigma), 0, values + k);
  }
}

// Means of pixels between seven neighboring edges, of which `distances` are those from the center;
// the eighth is 0.
static inline float8 means_between(float8 distances, float sigma) {
  const float8 edges = distances / fabs(sigma);
  if (sigma < 0.0f) {
    const float8 beyond = complement_of_erf(fabs(edges));
    return mean_of_complements(edges, beyond, edges.s12345677, beyond.s12345677) *
           (PIXEL_MEAN_SCALE * -sigma);
  }
  const float8 within = error_function(edges);
  return (within.s12345677 - within) * (PIXEL_MEAN_SCALE * sigma);
}

// Pixel means of seven pixels, the first one's center at distance `first` - `low`; the eighth is 0.
static inline float8 seven_means(float first, float low, float sigma) {
  return means_between(first - 0.5f + (float8)(0, 1, 2, 3, 4, 5, 6, 7) - low, sigma);
}

static inline void add_wide_splat(float* tile, __global const TileSplat* splat, int2 rows,
                                  int2 columns, float mean_sigma, int form) {
  float along_x[TILE_WIDTH + 16], along_y[2 * LIMITS];
  columns.x = first_of_eights(columns);
  const float first_y = (float)rows.x + FIRST_Y - splat->y;
  const int rows_count = rows.y - rows.x + 1;
  fill_axis(along_x, (float)columns.x + FIRST_X - splat->x, LOW_X(*splat),
            columns.y - columns.x + 1, SIGMA_X(*splat), mean_sigma);
  fill_axis(along_y, first_y, LOW_Y(*splat), rows_count, splat->sigma, mean_sigma);
  fill_limits(along_y, first_y, LOW_Y(*splat), rows_count, splat);
  Window window;
  window.x = columns.x;
  for (; window.x <= columns.y; window.x += 8) {
    const float* along = along_y + (set_rows(&window, rows, 8, splat) - rows.x);
    update_window(tile, &window, load_eight(along_x + (window.x - columns.x)), along, splat, form);
  }
}

// How many rows are drawn of a window of at most seven: rows beside the splat take its tails, which
// is no less exact. Those of plain sums take less than a processor loses by a count that it did not
// foresee; of four or seven it foresees most.
#if LIGHT_ORDERED || KERNEL_CUT
#define DRAWN_ROWS(count) (count)
#else
#define FEW_ROWS 4
#define DRAWN_ROWS(count) ((count) <= FEW_ROWS ? FEW_ROWS : 7)
#endif

// Draws a splat that touches these rows and columns of the tile.
static inline void add_splat(float* tile, __global const TileSplat* splat, int2 rows, int2 columns,
                             const SplatTile* of_tile, int form) {
  const float mean_sigma = of_tile->mean_sigma, sigma = splat->sigma, sigma_x = SIGMA_X(*splat);
  Window window;
  const int columns_count = columns.y - columns.x + 1, rows_count = rows.y - rows.x + 1;
#if !ELLIPSES
  if (columns_count <= 3 && rows_count <= 3 && sigma < mean_sigma) {
    // A grain: the edges of its pixels along both axes fit one call.
    window.rows = 3;
    window.x = first_column(columns.x, 3);
    window.y = min(rows.x, TILE_HEIGHT - window.rows);
    const float dx = (float)window.x + (FIRST_X - 0.5f) - splat->x;
    const float dy = (float)window.y + (FIRST_Y - 0.5f) - splat->y;
    const float8 low = (float8)((float4)(LOW_X(*splat)), (float4)(LOW_Y(*splat)));
    const float8 means = means_between(
        (float8)((float4)(dx), (float4)(dy)) + (float8)(0, 1, 2, 3, 0, 1, 2, 3) - low, sigma);
    float along[2 * LIMITS];
    vstore4(means.hi, 0, along);
    fill_limits(along, (float)window.y + FIRST_Y - splat->y, LOW_Y(*splat), window.rows, splat);
    update_window(tile, &window, (float8)(means.s012, 0.0f, (float4)(0.0f)), along, splat, form);
    return;
  }
#endif
#if KERNEL_CUT && !ELLIPSES
  // Most splats of a large snapshot whose kernel is cut.
  if (columns_count <= 4 && rows_count <= 4 && sigma >= mean_sigma) {
    // The centers of its pixels along both axes fit one call.
    window.rows = rows_count;
    window.x = first_column(columns.x, 4);
    window.y = min(rows.x, TILE_HEIGHT - window.rows);
    const float dx = (float)window.x + FIRST_X - splat->x;
    const float dy = (float)window.y + FIRST_Y - splat->y;
    const float8 low = (float8)((float4)(LOW_X(*splat)), (float4)(LOW_Y(*splat)));
    const float8 shape =
        gaussian((float8)((float4)(dx), (float4)(dy)) + (float8)(0, 1, 2, 3, 0, 1, 2, 3) - low,
                 inverse_of(sigma));
    float along[2 * LIMITS];
    vstore4(shape.hi, 0, along);
    fill_limits(along, dy, LOW_Y(*splat), window.rows, splat);
    update_window(tile, &window, (float8)(shape.lo, (float4)(0.0f)), along, splat, form);
    return;
  }
#endif
  if (columns_count <= 7 && rows_count <= 7) {
    // Most splats of a large snapshot: one window.
    window.rows = DRAWN_ROWS(rows_count);
    // Of means the eighth is 0.
    window.x = first_column(columns.x, sigma_x < mean_sigma ? 7 : 8);
    window.y = min(rows.x, TILE_HEIGHT - window.rows);
    float along[2 * LIMITS];
    const float dx = (float)window.x + FIRST_X - splat->x,
                dy = (float)window.y + FIRST_Y - splat->y;
    fill_limits(along, dy, LOW_Y(*splat), window.rows, splat);
    const float inverse = inverse_of(sigma);
    float8 across;
    if (sigma < mean_sigma) {
      across = seven_means(dx, LOW_X(*splat), sigma);
      vstore8(seven_means(dy, LOW_Y(*splat), sigma), 0, along);
    } else {
      across = gaussian(dx + (float8)(0, 1, 2, 3, 4, 5, 6, 7) - LOW_X(*splat), inverse);
      vstore8(gaussian(dy + (float8)(0, 1, 2, 3, 4, 5, 6, 7) - LOW_Y(*splat), inverse), 0, along);
    }
#if ELLIPSES
    across = sigma_x < mean_sigma ? seven_means(dx, LOW_X(*splat), sigma_x)
                                  : gaussian(dx + (float8)(0, 1, 2, 3, 4, 5, 6, 7) - LOW_X(*splat),
                                             inverse_of(sigma_x));
#endif
    update_window(tile, &window, across, along, splat, form);
    return;
  }
  add_wide_splat(tile, splat, rows, columns, mean_sigma, form);
}
