// Rows of eight pixels of a tile, and how a splat updates a window of them.
#include "kernels/bin/bin.h"
#include "kernels/common/common.cl"
#include "kernels/common/ellipse.h"
#include "kernels/common/lanes.cl"
#include "kernels/composite/composite.h"
#include "kernels/composite/opacity.cl"
#include "kernels/composite/pixel_range.cl"
#include "kernels/composite/shape.cl"

// No padding: a tile fits the nearest cache with room for its list. Rows of eight that begin where
// there are no eight columns left add nothing to the first pixels of the next row.
#define ROW TILE_WIDTH
// Planes at distances of 4096 bytes would share lines of the cache. Behind the last row there is
// room for one that begins in it, and before the first plane for stencils that begin beside it.
#define TILE_PIXELS (TILE_HEIGHT * ROW + 16)
#if STENCILS
#define BEFORE_TILE 16
#else
#define BEFORE_TILE 0
#endif
// The first pixel's center, from the tile's middle.
#define FIRST_X (0.5f - 0.5f * TILE_WIDTH)
#define FIRST_Y (0.5f - 0.5f * TILE_HEIGHT)
// Shapes of a splat on a face of a cube come row by row, and cut (face_rows.cl).
#if FACE_OF_CUBE
#define SHAPE_OF_ROW(k) load_eight(along + 8 * (k))
#else
#define SHAPE_OF_ROW(k) (across * along[k])
#endif

// As gaussian() wants it.
static inline float inverse_of(float sigma) {
  return 1.44269504f / (sigma * sigma);
}

#define CUT_BY_ROWS (KERNEL_CUT && !FACE_OF_CUBE)
// Where values along y are, those of rows are followed by how far from the center columns may lie
// in each at most, squared: along[LIMITS + k] of row k.
#define LIMITS (TILE_HEIGHT + 16)
#define SQUEEZED(dx) (ELLIPSES ? (dx)*squeeze : (dx))
#if CUT_BY_ROWS
// `shape` of the pixels of a row, zero beyond its limit; with means the pixel that holds the center
// keeps its light.
#if SAMPLING_MEAN
#define BESIDE_CENTER (dx <= -0.5f | dx > 0.5f | (int8)(dy <= -0.5f || dy > 0.5f ? -1 : 0))
#else
#define BESIDE_CENTER (int8)(-1)
#endif
static inline float8 cut_shape(float8 shape, float8 dx, float dy, float limit, float squeeze) {
  const int8 outside = SQUEEZED(dx) * SQUEEZED(dx) > limit;
  return select(shape, (float8)(0.0f), outside & BESIDE_CENTER);
}

// The limits of `count` rows, or of a few more, the first one's center at distance `first` - `low`.
static inline void fill_limits(float* along, float first, float low, int count,
                               __global const TileSplat* splat) {
  const float cut2 = cut_radius(splat->radius) * cut_radius(splat->radius);
  for (int k = 0; k < count; k += 8) {
    const float8 dy = first + (float)k + (float8)(0, 1, 2, 3, 4, 5, 6, 7) - low;
    vstore8(cut2 - dy * dy, 0, along + LIMITS + k);
  }
}
#else
#define cut_shape(shape, dx, dy, limit, squeeze) (shape)
#define fill_limits(along, first, low, count, splat)
#endif

// The splat's layer behind what is already there: with u = transmittance X phi(A X), S grows
// by E u and opacity by A u (opacity.cl). PASSED is exp(-A X). Written out for each channel,
// since compilers leave a loop of three as it is, and then fetch E and A anew for every row.
#define LAYER_CHANNEL(c, PHI, PASSED)                                        \
  {                                                                          \
    float* const source = pixel + c * TILE_PIXELS;                           \
    float* const opacity = pixel + (c + 3) * TILE_PIXELS;                    \
    const float8 o = load_eight(opacity), t = transmittance_of(o);           \
    const float8 depth = shape * absorption##c, phi = PHI(depth);            \
    const float8 covered = shape * phi;                                      \
    const float8 u = t * covered;                                            \
    store_eight(load_eight(source) + u * emission##c, source);               \
    store_eight(carry(o, u* absorption##c, t* PASSED(depth, phi)), opacity); \
  }

// The same with one to three terms of phi and the opacity as it is: X phi(A X) = X - (A / 2) X^2
// + (A^2 / 6) X^3, and nearly every line is one multiplication and addition.
#define COVERED_BY_ONE_TERM(c) (shape)
#define COVERED_BY_TWO_TERMS(c) (shape + (shape * shape) * (-0.5f * absorption##c))
#define COVERED_BY_THREE_TERMS(c) \
  (shape + (shape * shape) *      \
               (shape * (0.166666667f * absorption##c * absorption##c) - 0.5f * absorption##c))
#define THIN_CHANNEL(c, COVERED)                               \
  {                                                            \
    float* const source = pixel + c * TILE_PIXELS;             \
    float* const opacity = pixel + (c + 3) * TILE_PIXELS;      \
    const float8 o = load_eight(opacity);                      \
    const float8 covered = COVERED(c);                         \
    const float8 u = covered - o * covered;                    \
    store_eight(load_eight(source) + u * emission##c, source); \
    store_eight(o + u * absorption##c, opacity);               \
  }

#define THIN_LAYER(COVERED) \
  THIN_CHANNEL(0, COVERED)  \
  THIN_CHANNEL(1, COVERED)  \
  THIN_CHANNEL(2, COVERED)

// Differences of the error function may be negative by their error. A thin layer's opacity must
// not be: it would be read as a transmittance.
#define NOT_NEGATIVE(shape) (KEEP_TRANSMITTANCE ? max(shape, 0.0f) : (shape))

#define LAYER_ROWS(CHANNELS)                                                                \
  for (int k = 0; k < window->rows; ++k, pixel += ROW) {                                    \
    const float8 product = NOT_NEGATIVE(SHAPE_OF_ROW(k));                                   \
    const float8 shape = cut_shape(product, dx, dy + (float)k, along[LIMITS + k], squeeze); \
    CHANNELS                                                                                \
  }

#define LAYER_CHANNELS(PHI, PASSED) \
  LAYER_CHANNEL(0, PHI, PASSED)     \
  LAYER_CHANNEL(1, PHI, PASSED)     \
  LAYER_CHANNEL(2, PHI, PASSED)

// How a splat's layer is computed: what serves for its depth.
#define BY_ONE_TERM 0
#define BY_TWO_TERMS 1
#define BY_THREE_TERMS 2
#define BY_SERIES 3
#define IN_FULL 4

// Of a block of splats that are no deeper than this together no pixel is so opaque that its
// transmittance is carried.
#define DEPTH_OF_OPACITIES (KEEP_TRANSMITTANCE ? 0.45f : INFINITY)

static inline int form_of_layer(float deepest, float depth_of_block, const CompositeParameters* p) {
  if (deepest <= p->phi_third && depth_of_block <= DEPTH_OF_OPACITIES) {
    if (deepest <= p->phi_first) return BY_ONE_TERM;
    return deepest <= p->phi_short ? BY_TWO_TERMS : BY_THREE_TERMS;
  }
  return deepest <= p->phi_series ? BY_SERIES : IN_FULL;
}

// A row of a splat added to the sums, written out for each of them, as layers are.
#define SUMMED_CHANNEL(c) const float8 summed##c = across * splat->summed[c];
#define ADD_CHANNEL(c) \
  store_eight(load_eight(pixel + c * TILE_PIXELS) + shape * summed##c, pixel + c * TILE_PIXELS);
#define SUMMED_LIGHT SUMMED_CHANNEL(0) SUMMED_CHANNEL(1) SUMMED_CHANNEL(2)
#define ADD_LIGHT \
  ADD_CHANNEL(0)  \
  ADD_CHANNEL(1)  \
  ADD_CHANNEL(2)
#if SUMMED == 6
#define SUMMED_CHANNELS SUMMED_LIGHT SUMMED_CHANNEL(3) SUMMED_CHANNEL(4) SUMMED_CHANNEL(5)
#define ADD_CHANNELS \
  ADD_LIGHT          \
  ADD_CHANNEL(3)     \
  ADD_CHANNEL(4)     \
  ADD_CHANNEL(5)
#else
#define SUMMED_CHANNELS SUMMED_LIGHT
#define ADD_CHANNELS ADD_LIGHT
#endif

// The window that one splat updates: `count` rows of eight pixels from (x, y) on.
typedef struct Window {
  int x, y, rows;
} Window;

// The first of so many columns that begin at `first`, or farther left, where they would not all
// fit: columns beside the splat take its tails, which is no less exact.
static inline int first_column(int first, int count) {
  return min(first, TILE_WIDTH - count);
}

// The same of columns that are drawn in whole eights.
static inline int first_of_eights(int2 columns) {
  return first_column(columns.x, (columns.y - columns.x + 8) & ~7);
}

// Rows of a window of `width` columns: the splat's, or the disc's part of these columns. Returns
// the first.
static inline int set_rows(Window* window, int2 rows, int width, __global const TileSplat* splat) {
  if (KERNEL_CUT) {
    const float last = FIRST_X + (float)(width - 1);
    const float nearest =
        clamp(splat->x, (float)window->x + FIRST_X, (float)window->x + last) - splat->x;
    const float radius = splat->radius, in_radii = nearest / RADIUS_X(*splat);
    const float half_height = ELLIPSES ? radius * sqrt(max(1.0f - in_radii * in_radii, 0.0f))
                                       : sqrt(max(radius * radius - nearest * nearest, 0.0f));
    rows = pixel_range(splat->y, half_height, FIRST_Y, TILE_HEIGHT);
  }
  window->y = rows.x;
  window->rows = rows.y - rows.x + 1;
  return rows.x;
}

// Updates the window with across[8] * along[rows], where the kernel is cut within the rows' limits;
// on a face of a cube with along[rows][8].
static inline void update_window(float* tile, const Window* window, float8 across,
                                 const float* along, __global const TileSplat* splat, int form) {
#if CUT_BY_ROWS
  const float8 dx =
      (float)window->x + FIRST_X - splat->x + (float8)(0, 1, 2, 3, 4, 5, 6, 7) - LOW_X(*splat);
  const float dy = (float)window->y + FIRST_Y - splat->y - LOW_Y(*splat);
  const float squeeze = cut_radius(splat->radius) / cut_radius(RADIUS_X(*splat));
#endif
  float* pixel = tile + window->y * ROW + window->x;
#if LIGHT_ORDERED
  const float8 absorption0 = splat->absorption[0], emission0 = splat->emission[0];
  const float8 absorption1 = splat->absorption[1], emission1 = splat->emission[1];
  const float8 absorption2 = splat->absorption[2], emission2 = splat->emission[2];
  if (form == BY_ONE_TERM) {
    LAYER_ROWS(THIN_LAYER(COVERED_BY_ONE_TERM))
  } else if (form == BY_TWO_TERMS) {
    LAYER_ROWS(THIN_LAYER(COVERED_BY_TWO_TERMS))
  } else if (form == BY_THREE_TERMS) {
    LAYER_ROWS(THIN_LAYER(COVERED_BY_THREE_TERMS))
  } else if (form == BY_SERIES) {
    LAYER_ROWS(LAYER_CHANNELS(phi_series, passed_by_series))
  } else {
    LAYER_ROWS(LAYER_CHANNELS(phi_full, passed_in_full))
  }
#else
  SUMMED_CHANNELS
#pragma unroll 4
  for (int k = 0; k < window->rows; ++k, pixel += ROW) {
    const float8 shape =
        FACE_OF_CUBE ? SHAPE_OF_ROW(k)
                     : cut_shape((float8)(along[k]), dx, dy + (float)k, along[LIMITS + k], squeeze);
    ADD_CHANNELS
  }
#endif
}
