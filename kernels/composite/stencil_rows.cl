// Stencils in rows of eight pixels: every one is eight of them.
#include "kernels/bin/bin.h"
#include "kernels/bin/entry_lanes.cl"
#include "kernels/common/common.cl"
#include "kernels/common/grid.h"
#include "kernels/common/lanes.cl"
#include "kernels/composite/rows.cl"
#include "kernels/composite/stencil.cl"

#if STENCILS

// What eight of a list's stencils are drawn by, worked out for all of them at once: a processor
// draws one while it fetches the next.
typedef struct StencilBatch {
  int column[LANES], row[LANES];  // the first ones
  float across[LANES], along[LANES], width[LANES];
  float across2[LANES], along2[LANES];  // squares
  // The weights of rows between zeros, from where the tile's part of them is taken: only the middle
  // is written anew for each stencil.
  float of_rows[3 * STENCIL_PIXELS];
  int in_tile[STENCIL_PIXELS + TILE_WIDTH + STENCIL_PIXELS];  // -1 for columns of the tile, or 0
} __attribute__((aligned(32))) StencilBatch;

static inline void clear_stencils(StencilBatch* batch) {
  for (int k = 0; k < 3 * STENCIL_PIXELS; k += 8)
    store_eight((float8)(0.0f), batch->of_rows + k);
  for (int x = -STENCIL_PIXELS; x < TILE_WIDTH + STENCIL_PIXELS; x += 8)
    vstore8((int8)(x >= 0 && x < TILE_WIDTH ? -1 : 0), 0, batch->in_tile + STENCIL_PIXELS + x);
}

// Lists have splats that do not touch the tile, too: they lie beside it.
INLINED INTEGER beside_tile(INTEGER first, int size) {
  return min(max(first, (INTEGER)(-STENCIL_PIXELS)), (INTEGER)(size));
}

INLINED void find_stencils(const EntryLanes lanes, __global const Stencil* stencil,
                           StencilBatch* batch) {
  const StencilPlaces across = stencil_places(lanes.x, FIRST_X);
  const StencilPlaces along = stencil_places(lanes.y, FIRST_Y);
  STORE(beside_tile(across.first, TILE_WIDTH), batch->column);
  STORE(beside_tile(along.first, TILE_HEIGHT), batch->row);
  STORE(across.distance, batch->across);
  STORE(along.distance, batch->along);
  STORE(across.distance * across.distance, batch->across2);
  STORE(along.distance * along.distance, batch->along2);
  STORE(stencil_widths(lanes.sigma, stencil), batch->width);
}

// From the first pixel on, and their reflection from the last one back. In one vector, since a
// processor does not forward two halves that were stored to a load of the whole.
INLINED float8 stencil_weights(const StencilOfWidth of_width, float distance, float square) {
  const float8 parts = stencil_polynomials(of_width, square);
  const float8 signs = (float8)(1.0f, 1.0f, 1.0f, 1.0f, -1.0f, -1.0f, -1.0f, -1.0f);
  return parts.s01233210 + (distance * signs) * parts.s45677654;
}

// The product of weights along both axes times what is summed.
INLINED void add_rows(float* pixel, float8 across, const float* along,
                      __global const TileSplat* splat) {
  SUMMED_CHANNELS
#pragma unroll
  for (int k = 0; k < STENCIL_PIXELS; ++k, pixel += ROW) {
    const float8 shape = (float8)(along[k]);
    ADD_CHANNELS
  }
}

// Eight rows of eight pixels. Those beside the tile are others of its memory, which is about as
// large: nothing is added to them.
INLINED void add_stencil(float* tile, StencilBatch* batch, int i, __global const TileSplat* splat,
                         __global const Stencil* stencil) {
  const StencilOfWidth of_width = stencil_of_width(stencil, batch->width[i], 0);
  const int first_column = batch->column[i], first_row = batch->row[i];
  const float8 weights = stencil_weights(of_width, batch->across[i], batch->across2[i]);
  const int8 in_tile = load_eight_integers(batch->in_tile + STENCIL_PIXELS + first_column);
  const float8 across = as_float8(as_int8(weights) & in_tile);
  store_eight(stencil_weights(of_width, batch->along[i], batch->along2[i]),
              batch->of_rows + STENCIL_PIXELS);
  const int row = min(max(first_row, 0), TILE_HEIGHT - STENCIL_PIXELS);
  add_rows(tile + row * ROW + first_column, across,
           batch->of_rows + (STENCIL_PIXELS + row - first_row), splat);
}
#endif
