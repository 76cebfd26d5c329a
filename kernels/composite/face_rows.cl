// A splat in a tile of a face of a cube, eight pixels of a row at a time. Its ellipse lies askew,
// so that each row has a shape of its own.
#include "kernels/bin/bin.h"
#include "kernels/common/ellipse.h"
#include "kernels/common/grid.h"
#include "kernels/composite/composite.h"
#include "kernels/composite/face_shape.cl"
#include "kernels/composite/rows.cl"
#include "kernels/composite/shape.cl"

// What all splats of a tile share.
typedef TileOnFace SplatTile;

static inline SplatTile splat_tile(const Grid grid, uint tile, const CompositeParameters* p) {
  return tile_on_face(p->face, grid, tile);
}

// The window's rows of eight.
static inline void fill_rows(float* values, const Window* window, __global const TileSplat* splat,
                             const SplatTile* of_tile) {
  const float8 columns = (float)window->x + (float8)(0, 1, 2, 3, 4, 5, 6, 7);
  const float8 x = (of_tile->x + columns) * of_tile->per_focal;
  const float8 dx = columns + FIRST_X - splat->x - LOW_X(*splat);
  const Tilt tilt = splat->tilt;
  for (int k = 0; k < window->rows; ++k) {
    const float row = (float)(window->y + k), y = (of_tile->y + row) * of_tile->per_focal;
    const float dy = row + FIRST_Y - splat->y - LOW_Y(*splat);
    vstore8(face_shape(tilt, dx, dy, x, y, of_tile->cut2), 0, values + 8 * k);
  }
}

static inline void add_splat(float* tile, __global const TileSplat* splat, int2 rows, int2 columns,
                             const SplatTile* of_tile, int form) {
  float values[8 * TILE_HEIGHT];
  Window window;
  window.y = rows.x;
  window.rows = rows.y - rows.x + 1;
  window.x = first_of_eights(columns);
  for (; window.x <= columns.y; window.x += 8) {
    fill_rows(values, &window, splat, of_tile);
    update_window(tile, &window, (float8)(1.0f), values, splat, form);
  }
}
