// The shape of a splat on a face of a cube (src/scene/projection.h, FaceEllipse), on VALUEs
// (lanes.cl).
#include "kernels/common/common.cl"
#include "kernels/common/ellipse.h"
#include "kernels/common/grid.h"
#include "kernels/common/lanes.cl"
#include "kernels/composite/composite.h"
#include "kernels/composite/gaussian.cl"

#if FACE_OF_CUBE

// Where a tile's pixels lie on the face.
typedef struct TileOnFace {
  float x, y;       // of the first pixel's center, in pixels from the face's middle
  float per_focal;  // the tangent of a pixel
  float cut2;
} TileOnFace;

INLINED TileOnFace tile_on_face(const CubeFace face, const Grid grid, uint tile) {
  const uint in_grid = tile - grid.first_tile;
  const int left = grid.first_x + (int)(in_grid % (uint)grid.tiles_x) * TILE_WIDTH;
  const int top = grid.first_y + (int)(in_grid / (uint)grid.tiles_x) * TILE_HEIGHT;
  TileOnFace on_face;
  on_face.x = ((float)left + 0.5f - face.middle_x.high) - face.middle_x.low;
  on_face.y = ((float)top + 0.5f - face.middle_y.high) - face.middle_y.low;
  on_face.per_focal = face.inverse_focal.high;
  on_face.cut2 = face.cut2;
  return on_face;
}

// At (dx, dy) pixels from the splat's center, in a column and a row of these tangents.
INLINED VALUE face_shape(const Tilt tilt, VALUE dx, float dy, VALUE x, float y, float cut2) {
  const VALUE k = (1.0f + y * y) + x * x, turned = x * dy - y * dx;
  const VALUE inverse = 1.0f / (tilt.squared_width * k + tilt.footprint);
  const VALUE squared = (dx * dx + dy * dy) + turned * turned;
  const VALUE exponent = squared * inverse * tilt.inverse_secant2;
  const VALUE shape = exp2_negative(-exponent) * (tilt.scale * k * inverse);
#if KERNEL_CUT
  return choose((VALUE)(0.0f), shape, exponent <= cut2);
#else
  return shape;
#endif
}
#endif
