// Splats of a tile's list that wait until there are some, to be added to it together, patch by
// patch: a patch stays in registers while all of them are added to it, one after the other. Row by
// row each splat would load and store pixels that the one before has just stored, and a processor
// waits for that.
#include "kernels/bin/bin.h"
#include "kernels/common/common.cl"
#include "kernels/common/ellipse.h"
#include "kernels/composite/patch.cl"
#include "kernels/composite/patch_shapes.cl"
#include "kernels/composite/rows.cl"

// Layers take one term where they are no deeper than `first`, two down to `second`, and then three.
typedef struct LayerForms {
  ShapeBits more_terms;           // bits of the splats that take more than one somewhere
  float absorption[MOST_SHAPES];  // of the channel that absorbs most
  float first, second;
} LayerForms;

#if PLANES == 6
#define EACH_PLANE(DO) DO(0) DO(1) DO(2) DO(3) DO(4) DO(5)
#else
#define EACH_PLANE(DO) DO(0) DO(1) DO(2)
#endif

// Light, and behind it opacities in order; of PLANES planes.
typedef struct PatchRow {
  PATCH plane0, plane1, plane2, plane3, plane4, plane5;
} PatchRow;

#define LOAD_PLANE(c) row.plane##c = load_patch(pixel + c * TILE_PIXELS);
#define STORE_PLANE(c) store_patch(row.plane##c, pixel + c * TILE_PIXELS);
INLINED PatchRow load_patch_row(const float* pixel) {
  PatchRow row;
  EACH_PLANE(LOAD_PLANE)
  return row;
}
INLINED void store_patch_row(const PatchRow row, float* pixel) {
  EACH_PLANE(STORE_PLANE)
}

// A splat in the columns of a patch.
typedef struct PatchSplat {
  PATCH across;
  float most_across;
  const float *along, *light;
  PATCH light0, light1, light2, light3, light4, light5;  // of sums, in these columns
  // Where the kernel is cut.
  PATCH square, dx;
  const float* limits;
  float dy;  // of the first row
} PatchSplat;

#define PUT_LIGHT(c) splat.light##c = splat.across * splat.light[c];
INLINED PatchSplat splat_of_patch(const PatchShapes* shapes, const PatchValues* values, uint k,
                                  int x, int y, PATCH lanes) {
  PatchSplat splat;
  splat.across = load_patch(values->across + k * PATCH_WIDTH);
  splat.most_across = values->most_across[k];
  splat.along = values->along + (size_t)k * TILE_HEIGHT + y;
  splat.light = shapes->light + k * PLANES;
  if (!LIGHT_ORDERED) {
    EACH_PLANE(PUT_LIGHT)
  }
  if (CUT_BY_ROWS) {
    splat.square = load_patch(values->squares + k * PATCH_WIDTH);
    splat.limits = values->limits + (size_t)k * TILE_HEIGHT + y;
    splat.dx = DISTANCE_ALONG(&shapes->x, k, ((float)x + FIRST_X) + lanes);
    splat.dy = (float)y + FIRST_Y - shapes->y.place[k];
  }
  return splat;
}

// Of means the pixel that holds the center keeps its light.
INLINED PATCH_INTEGERS holds_center(const PatchSplat splat, int k) {
  const float dy = splat.dy + (float)k;
  return (splat.dx > -0.5f) & (splat.dx <= 0.5f) &
         (PATCH_INTEGERS)(dy > -0.5f && dy <= 0.5f ? -1 : 0);
}

// Of the pixels of row k, those that the kernel is not cut at.
INLINED PATCH where_drawn(const PatchSplat splat, int k, PATCH drawn, PATCH otherwise) {
  if (!CUT_BY_ROWS) return drawn;
  const PATCH_INTEGERS within = splat.square <= splat.limits[k];
  return select(otherwise, drawn, SAMPLING_MEAN ? within | holds_center(splat, k) : within);
}

INLINED PATCH shape_in_row(const PatchSplat splat, int k) {
  return where_drawn(splat, k, NOT_NEGATIVE(splat.across * splat.along[k]), (PATCH)(0.0f));
}

// A layer as THIN_LAYER() (rows.cl) has it: channel c's light and opacity are planes c and `o`.
#define PATCH_CHANNEL(c, o, COVERED)                  \
  {                                                   \
    const float absorption##c = splat.light[o];       \
    const PATCH covered = COVERED(c);                 \
    const PATCH u = covered - row.plane##o * covered; \
    row.plane##c += u * splat.light[c];               \
    row.plane##o += u * absorption##c;                \
  }
#define PATCH_CHANNELS(COVERED) \
  PATCH_CHANNEL(0, 3, COVERED) PATCH_CHANNEL(1, 4, COVERED) PATCH_CHANNEL(2, 5, COVERED)
#define ADDITION_OF_LAYER(name, COVERED)                               \
  INLINED PatchRow name(PatchRow row, const PatchSplat splat, int k) { \
    const PATCH shape = shape_in_row(splat, k);                        \
    PATCH_CHANNELS(COVERED)                                            \
    return row;                                                        \
  }
ADDITION_OF_LAYER(add_one_term, COVERED_BY_ONE_TERM)
ADDITION_OF_LAYER(add_two_terms, COVERED_BY_TWO_TERMS)
ADDITION_OF_LAYER(add_three_terms, COVERED_BY_THREE_TERMS)

#define ADD_TO_PLANE(c) row.plane##c += splat.light##c * along;
#define ADD_TO_PLANE_WHERE_DRAWN(c) \
  row.plane##c = where_drawn(splat, k, row.plane##c + splat.light##c * along, row.plane##c);
// Additions take a mask where registers of sixteen are; elsewhere one mask serves all planes.
INLINED PatchRow add_to_sums(PatchRow row, const PatchSplat splat, int k) {
  const PATCH all = splat.along[k];
  if (ROWS_OF_16) {
    const PATCH along = all;
    EACH_PLANE(ADD_TO_PLANE_WHERE_DRAWN)
  } else {
    const PATCH along = where_drawn(splat, k, all, (PATCH)(0.0f));
    EACH_PLANE(ADD_TO_PLANE)
  }
  return row;
}

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
// Most of a layer is far less deep than its middle.
#define ADD_AS_DEEP_AS_HERE                                    \
  const float deepest = forms->absorption[k] * most_in(splat); \
  if (deepest <= forms->first) {                               \
    EACH_ROW(ADD_ONE_TERM)                                     \
  } else if (deepest <= forms->second) {                       \
    EACH_ROW(ADD_TWO_TERMS)                                    \
  } else {                                                     \
    EACH_ROW(ADD_THREE_TERMS)                                  \
  }

// The most of the splat's shape in the patch.
INLINED float most_in(const PatchSplat splat) {
  float most = splat.along[0];
  for (int k = 1; k < PATCH_HEIGHT; ++k)
    most = splat.along[k] > most ? splat.along[k] : most;
  return most * splat.most_across;
}

// Those of `splats`, of which there are some, to the patch from (x, y) on.
#define ADD_EACH_SPLAT(ROWS)                                                 \
  for (; splats != 0; splats = without_first(splats)) {                      \
    const uint k = first_of(splats);                                         \
    const PatchSplat splat = splat_of_patch(shapes, values, k, x, y, lanes); \
    ROWS                                                                     \
  }
INLINED void add_to_patch(float* tile, int x, int y, const PatchShapes* shapes,
                          const PatchValues* values, const LayerForms* forms, PATCH lanes) {
  ShapeBits splats = splats_of_patch(&shapes->reach, x / PATCH_WIDTH, y / PATCH_HEIGHT);
  if (splats == 0) return;
  float* pixel = tile + y * ROW + x;
  EACH_ROW(LOAD_ROW_OF_PATCH)
  if (!LIGHT_ORDERED) {
    ADD_EACH_SPLAT(EACH_ROW(ADD_TO_SUMS))
  } else if ((splats & forms->more_terms) == 0) {
    ADD_EACH_SPLAT(EACH_ROW(ADD_ONE_TERM))
  } else {
    ADD_EACH_SPLAT(ADD_AS_DEEP_AS_HERE)
  }
  EACH_ROW(STORE_ROW_OF_PATCH)
}

// Those in the rows from y on that a register holds.
INLINED ShapeBits splats_of_rows(const PatchReach* reach, int y) {
  ShapeBits splats = 0;
  for (int row = y; row < y + PATCH_WIDTH; row += PATCH_HEIGHT)
    splats |= splats_of_row(reach, row / PATCH_HEIGHT);
  return splats;
}

// Adds the splats of these shapes to the tile. A call whose argument tells the compiler that it may
// use registers of sixteen floats (lanes.cl).
__attribute__((noinline)) static void add_to_patches(float* tile, const PatchShapes* shapes,
                                                     const LayerForms* forms, PATCH lanes) {
  PatchValues values;
  const PatchReach* const reach = &shapes->reach;
  for (int y = 0; y < TILE_HEIGHT; y += PATCH_WIDTH)
    fill_along(shapes, splats_of_rows(reach, y), y, lanes, &values);
  for (int x = 0; x < TILE_WIDTH; x += PATCH_WIDTH) {
    const ShapeBits of_column = splats_of_column(reach, x / PATCH_WIDTH);
    if (of_column == 0) continue;
    fill_across(shapes, of_column, x, lanes, &values);
    for (int y = 0; y < TILE_HEIGHT; y += PATCH_HEIGHT)
      add_to_patch(tile, x, y, shapes, &values, forms, lanes);
  }
}

typedef struct WaitingSplats {
  PatchShapes shapes;
  uint count;
  LayerForms forms;
} WaitingSplats;

static inline void clear_waiting(WaitingSplats* waiting) {
  clear_reach(&waiting->shapes.reach);
  waiting->shapes.x.means = waiting->shapes.y.means = 0;
  waiting->count = 0;
  waiting->forms.more_terms = 0;
}

// Adds those that wait to the tile.
static inline void add_waiting(float* tile, WaitingSplats* waiting) {
  if (waiting->count == 0) return;
  add_to_patches(tile, &waiting->shapes, &waiting->forms, PATCH_LANES);
  clear_waiting(waiting);
}

// Splats up to so many pixels are drawn row by row, of those whose rows have no loop over columns
// (narrow_splats.cl): in patches they would fill too few pixels.
#define HAS_LOOPS_OVER_COLUMNS \
  (KERNEL_CUT || (ROWS_OF_16 && !LIGHT_ORDERED && (ELLIPSES || FINE_PLACES || SUMMED == 6)))
#define WIDEST_ALONE (HAS_LOOPS_OVER_COLUMNS ? 7 : 16)

// Whether a splat that touches `rows` and `columns` of the tile waits: wide ones do, and in order
// all behind them. Bright ones take other formulas, and deep layers, one by one.
static inline int waits(const WaitingSplats* waiting, int2 rows, int2 columns,
                        __global const TileSplat* splat, int form) {
  const int widest = max(columns.y - columns.x, rows.y - rows.x) + 1;
  const int is_dim = SIGMA_X(*splat) > 0.0f && splat->sigma > 0.0f;
  if (!LIGHT_ORDERED) return is_dim && widest > WIDEST_ALONE;
  return form <= BY_THREE_TERMS && is_dim && (widest > WIDEST_ALONE || waiting->count > 0);
}

// Lets a splat wait, and adds those that wait when there is no room for more.
static inline void let_wait(float* tile, WaitingSplats* waiting, int2 rows, int2 columns,
                            __global const TileSplat* splat, float mean_sigma, int form) {
  const uint number = waiting->count++;
  put_splat(&waiting->shapes, number, rows, columns, splat, mean_sigma);
  if (LIGHT_ORDERED) {
    const float* absorption = waiting->shapes.light + (number + 1) * PLANES - 3;
    waiting->forms.more_terms |= (ShapeBits)(form > BY_ONE_TERM) << number;
    waiting->forms.absorption[number] = max(absorption[0], max(absorption[1], absorption[2]));
  }
  if (waiting->count == MOST_SHAPES) add_waiting(tile, waiting);
}

// The same of one that does, and, in order, adds those that wait before one that does not.
static inline int let_wait_if_it_does(float* tile, WaitingSplats* waiting, int2 rows, int2 columns,
                                      __global const TileSplat* splat, float mean_sigma, int form) {
  // On faces of cubes each row has a shape of its own.
  if (FACE_OF_CUBE) return 0;
  if (waits(waiting, rows, columns, splat, form)) {
    let_wait(tile, waiting, rows, columns, splat, mean_sigma, form);
    return 1;
  }
  if (LIGHT_ORDERED) add_waiting(tile, waiting);
  return 0;
}
