// Shapes of splats in double precision, eight pixels of a row of a tile at a time.
#include "kernels/common/common.cl"
#include "kernels/common/double_lanes.cl"
#include "kernels/common/ellipse.h"
#include "kernels/common/grid.h"
#include "kernels/common/splat.h"
#include "kernels/composite/composite.h"
#include "kernels/composite/extended_means.cl"

#pragma OPENCL FP_CONTRACT ON

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

// Pixels along one axis of the tile; none where last < first. On a face of a cube the shape along
// an axis is 1 as far as the splat is drawn: its ellipse lies askew.
typedef struct Axis {
  double shape[TILE_WIDTH + 8];  // tiles are no higher than wide
  int first, last;
} Axis;

INLINED int is_empty(const Axis* axis) {
  return axis->first > axis->last;
}

static inline void fill_centers(double* values, double first, int begin, int end, double sigma) {
  for (int k = begin; k < end; k += 8) {
    const double8 u = (first + (double)k + ramp_of_eight()) / sigma;
    vstore8(exp_of_minus(min(u * u, (double8)(700.0))), 0, values + k);
  }
}

// `size` pixels of a tile, the first of which has its center at `corner`, in whole eights; nothing
// beyond the radius.
static inline void fill_axis(Axis* axis, double corner, int size, FloatPair center, FloatPair sigma,
                             float radius) {
  const double first = corner - in_full(center), reach = (double)radius;
  const double low = -first - reach, high = -first + reach;
  axis->first = low <= 0.0 ? 0 : low > (double)size ? size : (int)ceil(low);
  axis->last = high >= (double)(size - 1) ? size - 1 : high < 0.0 ? -1 : (int)high;
  if (is_empty(axis)) return;
  const int begin = axis->first & ~7, end = (axis->last & ~7) + 8;
  if (!FACE_OF_CUBE && SAMPLING_MEAN && are_wide_means(in_full(sigma), reach + 8.0)) {
    fill_wide_means(axis->shape, first, begin, end, in_full(sigma));
  } else if (!FACE_OF_CUBE && SAMPLING_MEAN && sigma.high < 1e4f) {
    fill_means(axis->shape, first, begin, end, in_full(sigma));
  } else if (!FACE_OF_CUBE) {
    fill_centers(axis->shape, first, begin, end, in_full(sigma));
  }
  for (int k = begin; k < end; k += 8) {
    const double8 d = first + (double)k + ramp_of_eight();
    const double8 shape = FACE_OF_CUBE ? (double8)(1.0) : vload8(0, axis->shape + k);
    vstore8(select(shape, (double8)(0.0), fabs(d) > reach), 0, axis->shape + k);
  }
}

static inline void fill_along_x(Axis* axis, const Splat* splat, double corner, int size) {
#if ELLIPSES
  const FloatPair sigma = splat->extended.sigma_x;
#else
  const FloatPair sigma = splat->extended.sigma;
#endif
  fill_axis(axis, corner, size, splat->extended.x, sigma, RADIUS_X(*splat));
}
static inline void fill_along_y(Axis* axis, const Splat* splat, double corner, int size) {
  fill_axis(axis, corner, size, splat->extended.y, splat->extended.sigma, splat->radius);
}

// In eight pixels from (x, y) of the tile on, from the product of both axes; zero outside the cut.
INLINED double8 shape_of_eight(const ExtendedSplat* splat, const ExtendedTile* of_tile,
                               double8 product, int x, int y) {
  const double8 columns = (double)x + ramp_of_eight();
  const double8 dx = of_tile->corner_x - in_full(splat->x) + columns;
  const double dy = of_tile->corner_y - in_full(splat->y) + (double)y, cut = in_full(splat->cut);
#if FACE_OF_CUBE
  // face_shape() of face_shape.cl.
  const double8 u = (of_tile->corner_x - of_tile->face_x + columns) * of_tile->tangent;
  const double v = (of_tile->corner_y - of_tile->face_y + (double)y) * of_tile->tangent;
  const double8 k = (1.0 + v * v) + u * u, turned = u * dy - v * dx;
  const double8 gk = in_full(splat->tilt.squared_width) * k;
  const double8 inverse = 1.0 / (gk + in_full(splat->tilt.footprint));
  const double8 squared = (dx * dx + dy * dy) + turned * turned;
  const double8 exponent = squared * inverse * in_full(splat->tilt.inverse_secant2);
  product *= exp_of_minus(min(exponent, (double8)(700.0))) * (gk * inverse);
  return KERNEL_CUT ? select((double8)(0.0), product, exponent <= cut * cut) : product;
#else
  if (!KERNEL_CUT) return product;
#if ELLIPSES
  // As in the disc that the ellipse is made of.
  const double8 round_dx = dx * (in_full(splat->sigma) / in_full(splat->sigma_x));
#else
  const double8 round_dx = dx;
#endif
  long8 inside = round_dx * round_dx + dy * dy <= cut * cut;
  // Means begin at their own edge: the pixel that holds the center is drawn.
  if (SAMPLING_MEAN) inside |= (dx > -0.5) & (dx <= 0.5) & (long8)(dy > -0.5 && dy <= 0.5 ? -1 : 0);
  return select((double8)(0.0), product, inside);
#endif
}
