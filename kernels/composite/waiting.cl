// Splats of a tile's list that wait until there are some, to be added to it together (patches.cl).
#include "kernels/bin/bin.h"
#include "kernels/common/common.cl"
#include "kernels/common/ellipse.h"
#include "kernels/composite/patch.cl"
#include "kernels/composite/patch_reach.cl"
#include "kernels/composite/patch_shapes.cl"
#include "kernels/composite/patches.cl"
#include "kernels/composite/rows.cl"

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
