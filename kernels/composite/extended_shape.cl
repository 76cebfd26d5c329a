// Shapes of splats in double precision, eight pixels of a row of a tile at a time.
#include "kernels/common/common.cl"
#include "kernels/common/ellipse.h"
#include "kernels/common/grid.h"
#include "kernels/composite/composite.h"
#include "kernels/composite/extended_means.cl"
#include "kernels/extended/double_lanes.cl"
#include "kernels/extended/extended_splat.h"

#pragma OPENCL FP_CONTRACT ON

// Pixels along one axis of the tile; none where last < first.
typedef struct PixelRange {
  int first, last;
} PixelRange;

// `first` is the distance of the first pixel's center.
static inline PixelRange pixels_of_axis(double first, double reach, int size) {
  const double low = -first - reach, high = -first + reach;
  PixelRange range;
  range.first = low <= 0.0 ? 0 : low > (double)size ? size : (int)ceil(low);
  range.last = high >= (double)(size - 1) ? size - 1 : high < 0.0 ? -1 : (int)high;
  return range;
}

// From the picture's middle, as places of splats.
typedef struct ExtendedTile {
  double corner_x, corner_y;       // the first pixel's center
  double face_x, face_y, tangent;  // of a face of a cube: its middle, and from a pixel to the next
} ExtendedTile;

INLINED ExtendedTile extended_tile(uint tile, const Grid grid, const CubeFace face) {
  const uint in_grid = tile - grid.first_tile, tiles_x = (uint)grid.tiles_x;
  const int column = (int)(in_grid % tiles_x), row = (int)(in_grid / tiles_x);
  ExtendedTile found;
  found.corner_x = (double)(grid.first_x + column * TILE_WIDTH - grid.middle_x) + 0.5;
  found.corner_y = (double)(grid.first_y + row * TILE_HEIGHT - grid.middle_y) + 0.5;
  found.face_x = in_full(face.middle_x) - (double)grid.middle_x;
  found.face_y = in_full(face.middle_y) - (double)grid.middle_y;
  found.tangent = in_full(face.inverse_focal);
  return found;
}

#if FACE_OF_CUBE
typedef struct ExtendedShape {
  PixelRange columns, rows;
  double x, y;                           // from the splat's center to the first pixel's
  double tangent_x, tangent_y, tangent;  // of the first pixel, and from one to the next
  double squared_width, footprint, inverse_secant2, cut2;
} ExtendedShape;

// Whether the splat reaches the tile.
static inline int start_shape(ExtendedShape* shape, const ExtendedSplat* splat,
                              const ExtendedTile* of_tile) {
  shape->x = of_tile->corner_x - in_full(splat->x);
  shape->y = of_tile->corner_y - in_full(splat->y);
  shape->columns = pixels_of_axis(shape->x, (double)RADIUS_X(*splat), TILE_WIDTH);
  shape->rows = pixels_of_axis(shape->y, (double)splat->radius, TILE_HEIGHT);
  shape->tangent = of_tile->tangent;
  shape->tangent_x = (of_tile->corner_x - of_tile->face_x) * shape->tangent;
  shape->tangent_y = (of_tile->corner_y - of_tile->face_y) * shape->tangent;
  shape->squared_width = in_full(splat->tilt.squared_width);
  shape->footprint = in_full(splat->tilt.footprint);
  shape->inverse_secant2 = in_full(splat->tilt.inverse_secant2);
  shape->cut2 = in_full(splat->cut) * in_full(splat->cut);
  return shape->columns.first <= shape->columns.last && shape->rows.first <= shape->rows.last;
}

// What eight columns of pixels share.
typedef struct ShapeColumns {
  double8 dx, x;
} ShapeColumns;

INLINED ShapeColumns shape_columns(const ExtendedShape* shape, int first) {
  const double8 columns = (double)first + ramp_of_eight();
  return (ShapeColumns){shape->x + columns, shape->tangent_x + columns * shape->tangent};
}

// face_shape() of face_shape.cl.
INLINED double8 shape_of_eight(const ExtendedShape* shape, const ShapeColumns columns, int row) {
  const double8 dx = columns.dx, x = columns.x;
  const double dy = shape->y + (double)row, y = shape->tangent_y + (double)row * shape->tangent;
  const double8 k = (1.0 + y * y) + x * x;
  const double8 gk = shape->squared_width * k, turned = x * dy - y * dx;
  const double8 inverse = 1.0 / (gk + shape->footprint);
  const double8 squared = (dx * dx + dy * dy) + turned * turned;
  const double8 exponent = squared * inverse * shape->inverse_secant2;
  const double8 value = exp_of_minus(min(exponent, (double8)(700.0))) * (gk * inverse);
#if KERNEL_CUT
  return select((double8)(0.0), value, exponent <= shape->cut2);
#else
  return value;
#endif
}
#else
// A splat's shape along one axis of the tile, and what decides whether a pixel is in a cut disc.
typedef struct Axis {
  double shape[TILE_WIDTH + 8];   // tiles are no higher than wide
#if KERNEL_CUT
  double square[TILE_WIDTH + 8];  // of the distance
  long holds[TILE_WIDTH + 8];     // -1 where the pixel holds the center: it begins at its own edge
#endif
  PixelRange range;
} Axis;

static inline void fill_centers(double* values, double first, int begin, int end, double sigma) {
  for (int k = begin; k < end; k += 8) {
    const double8 u = (first + (double)k + ramp_of_eight()) / sigma;
    vstore8(exp_of_minus(min(u * u, (double8)(700.0))), 0, values + k);
  }
}

// `size` pixels of a tile, the first of which has its center at `corner`, in whole eights;
// nothing beyond the radius. `squeeze`: from distances to those in the disc that an ellipse is made
// of.
static inline void fill_axis(Axis* axis, double corner, int size, FloatPair center, FloatPair sigma,
                             float radius, double squeeze) {
  const double first = corner - in_full(center), reach = (double)radius;
  axis->range = pixels_of_axis(first, reach, size);
  if (axis->range.first > axis->range.last) return;
  const int begin = axis->range.first & ~7, end = (axis->range.last & ~7) + 8;
#if SAMPLING_MEAN
  if (are_wide_means(in_full(sigma), reach + 8.0)) {
    fill_wide_means(axis->shape, first, begin, end, in_full(sigma));
  } else if (sigma.high < 1e4f) {
    fill_means(axis->shape, first, begin, end, in_full(sigma));
  } else
#endif
    fill_centers(axis->shape, first, begin, end, in_full(sigma));
  for (int k = begin; k < end; k += 8) {
    const double8 d = first + (double)k + ramp_of_eight();
    const double8 shape = vload8(0, axis->shape + k);
    vstore8(select(shape, (double8)(0.0), fabs(d) > reach), 0, axis->shape + k);
#if KERNEL_CUT
    vstore8((d * squeeze) * (d * squeeze), 0, axis->square + k);
    vstore8((d > -0.5) & (d <= 0.5), 0, axis->holds + k);
#endif
  }
}

static inline void fill_along_x(Axis* axis, const ExtendedSplat* splat, double corner, int size) {
#if ELLIPSES
  const double squeeze = in_full(splat->sigma) / in_full(splat->along_x.sigma);
#else
  const double squeeze = 1.0;
#endif
  fill_axis(axis, corner, size, splat->x, SIGMA_X(*splat), RADIUS_X(*splat), squeeze);
}
static inline void fill_along_y(Axis* axis, const ExtendedSplat* splat, double corner, int size) {
  fill_axis(axis, corner, size, splat->y, splat->sigma, splat->radius, 1.0);
}

// The product of one along x and one along y.
typedef struct ExtendedShape {
  PixelRange columns, rows;
  Axis along_x, along_y;
  double cut_square;
} ExtendedShape;

// Whether the splat reaches the tile.
static inline int start_shape(ExtendedShape* shape, const ExtendedSplat* splat,
                              const ExtendedTile* of_tile) {
  fill_along_x(&shape->along_x, splat, of_tile->corner_x, TILE_WIDTH);
  shape->columns = shape->along_x.range;
  if (shape->columns.first > shape->columns.last) return 0;
  fill_along_y(&shape->along_y, splat, of_tile->corner_y, TILE_HEIGHT);
  shape->rows = shape->along_y.range;
  const double cut = in_full(splat->cut);
  shape->cut_square = cut * cut;
  return shape->rows.first <= shape->rows.last;
}

// What eight columns of pixels share.
typedef struct ShapeColumns {
  double8 shape;
#if KERNEL_CUT
  double8 square;
  long8 holds;
#endif
} ShapeColumns;

INLINED ShapeColumns shape_columns(const ExtendedShape* shape, int first) {
  ShapeColumns columns;
  columns.shape = vload8(0, shape->along_x.shape + first);
#if KERNEL_CUT
  columns.square = vload8(0, shape->along_x.square + first);
  columns.holds = vload8(0, shape->along_x.holds + first);
#endif
  return columns;
}

// And what a row of them does.
typedef struct ShapeRow {
  double shape;
#if KERNEL_CUT
  double square;
  long holds;
#endif
} ShapeRow;

INLINED ShapeRow shape_row(const Axis* along_y, int row) {
  ShapeRow values;
  values.shape = along_y->shape[row];
#if KERNEL_CUT
  values.square = along_y->square[row];
  values.holds = along_y->holds[row];
#endif
  return values;
}

// Zero outside the cut.
INLINED double8 product_of(const ShapeColumns columns, const ShapeRow row, double cut_square) {
  const double8 product = columns.shape * row.shape;
#if KERNEL_CUT
  long8 inside = columns.square + row.square <= cut_square;
#if SAMPLING_MEAN
  inside |= columns.holds & (long8)(row.holds);
#endif
  return select((double8)(0.0), product, inside);
#else
  return product;
#endif
}

INLINED double8 shape_of_eight(const ExtendedShape* shape, const ShapeColumns columns, int row) {
  return product_of(columns, shape_row(&shape->along_y, row), shape->cut_square);
}
#endif
