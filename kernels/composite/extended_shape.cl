// Shapes of splats in double precision, eight pixels of a row of a tile at a time.

inline double in_full(FloatPair a) {
  return (double)a.high + (double)a.low;
}

inline double8 ramp_of_eight() {
  return (double8)(0, 1, 2, 3, 4, 5, 6, 7);
}

// Pixels along one axis of the tile; none where last < first.
typedef struct PixelRange {
  int first, last;
} PixelRange;

// `first` is the distance of the first pixel's center.
inline PixelRange pixels_of_axis(double first, double reach, int size) {
  const double low = -first - reach, high = -first + reach;
  PixelRange range;
  range.first = low <= 0.0 ? 0 : low > (double)size ? size : (int)ceil(low);
  range.last = high >= (double)(size - 1) ? size - 1 : high < 0.0 ? -1 : (int)high;
  return range;
}

typedef struct ExtendedTile {
  double corner_x, corner_y;  // the first pixel's center
  CubeFace face;
} ExtendedTile;

#ifdef FACE_OF_CUBE
typedef struct ExtendedShape {
  PixelRange columns, rows;
  double x, y;                           // from the splat's center to the first pixel's
  double tangent_x, tangent_y, tangent;  // of the first pixel, and from one to the next
  double squared_width, footprint, inverse_secant2, cut2;
} ExtendedShape;

// Whether the splat reaches the tile.
inline int start_shape(ExtendedShape* shape, const ExtendedSplat* splat,
                       const ExtendedTile* of_tile) {
  shape->x = of_tile->corner_x - in_full(splat->x);
  shape->y = of_tile->corner_y - in_full(splat->y);
  shape->columns = pixels_of_axis(shape->x, (double)RADIUS_X(*splat), TILE_WIDTH);
  shape->rows = pixels_of_axis(shape->y, (double)splat->radius, TILE_HEIGHT);
  shape->tangent = in_full(of_tile->face.inverse_focal);
  shape->tangent_x = (of_tile->corner_x - in_full(of_tile->face.middle_x)) * shape->tangent;
  shape->tangent_y = (of_tile->corner_y - in_full(of_tile->face.middle_y)) * shape->tangent;
  shape->squared_width = in_full(splat->tilt.squared_width);
  shape->footprint = in_full(splat->tilt.footprint);
  shape->inverse_secant2 = in_full(splat->tilt.inverse_secant2);
  shape->cut2 = in_full(splat->cut) * in_full(splat->cut);
  return shape->columns.first <= shape->columns.last && shape->rows.first <= shape->rows.last;
}

// face_shape() of face_shape.cl.
inline double8 shape_of_eight(const ExtendedShape* shape, int column, int row) {
  const double8 columns = (double)column + ramp_of_eight(), dx = shape->x + columns;
  const double dy = shape->y + (double)row, y = shape->tangent_y + (double)row * shape->tangent;
  const double8 x = shape->tangent_x + columns * shape->tangent, k = (1.0 + y * y) + x * x;
  const double8 gk = shape->squared_width * k, turned = x * dy - y * dx;
  const double8 inverse = 1.0 / (gk + shape->footprint);
  const double8 squared = (dx * dx + dy * dy) + turned * turned;
  const double8 exponent = squared * inverse * shape->inverse_secant2;
  const double8 value = exp_of_minus(min(exponent, (double8)(700.0))) * (gk * inverse);
#ifdef KERNEL_CUT
  return select((double8)(0.0), value, exponent <= shape->cut2);
#else
  return value;
#endif
}
#else
// A splat's shape along one axis of the tile, and what decides whether a pixel is in a cut disc.
typedef struct Axis {
  double shape[TILE_WIDTH + 8];   // tiles are no higher than wide
#ifdef KERNEL_CUT
  double square[TILE_WIDTH + 8];  // of the distance
  long holds[TILE_WIDTH + 8];     // -1 where the pixel holds the center: it begins at its own edge
#endif
  PixelRange range;
} Axis;

// The mean of exp(-d^2 / sigma^2) over pixels from 1 - erf of the distances of their edges.
inline double8 mean_of_complements(double8 left, double8 of_left, double8 right, double8 of_right) {
  const double8 beside = select(of_right - of_left, of_left - of_right, left >= 0.0);
  return select(beside, 2.0 - of_left - of_right, (left < 0.0) & (right > 0.0));
}

inline void fill_means(double* values, double first, int begin, int end, double sigma) {
  double beyond[TILE_WIDTH + 16];
  const double per_sigma = 1.0 / sigma;
  for (int k = begin; k <= end; k += 8) {
    const double8 edge = (first - 0.5 + (double)k + ramp_of_eight()) * per_sigma;
    vstore8(complement_of_erf(fabs(edge)), 0, beyond + k);
  }
  for (int k = begin; k < end; k += 8) {
    const double8 left = (first - 0.5 + (double)k + ramp_of_eight()) * per_sigma;
    const double8 right = (first + 0.5 + (double)k + ramp_of_eight()) * per_sigma;
    const double8 mean =
        mean_of_complements(left, vload8(0, beyond + k), right, vload8(0, beyond + k + 1));
    vstore8(mean * (0.88622692545275805 * sigma), 0, values + k);
  }
}

inline void fill_centers(double* values, double first, int begin, int end, double sigma) {
  for (int k = begin; k < end; k += 8) {
    const double8 u = (first + (double)k + ramp_of_eight()) / sigma;
    vstore8(exp_of_minus(min(u * u, (double8)(700.0))), 0, values + k);
  }
}

// Pixels of a tile of `size`, the first of which has its center at `corner`, in whole eights;
// nothing beyond the radius. `squeeze`: from distances to those in the disc that an ellipse is made
// of.
inline void fill_axis(Axis* axis, double corner, int size, FloatPair center, FloatPair sigma,
                      float radius, double squeeze) {
  const double first = corner - in_full(center), reach = (double)radius;
  axis->range = pixels_of_axis(first, reach, size);
  if (axis->range.first > axis->range.last) return;
  const int begin = axis->range.first & ~7, end = (axis->range.last & ~7) + 8;
#ifdef SAMPLING_MEAN
  if (sigma.high < 1e4f) {
    fill_means(axis->shape, first, begin, end, in_full(sigma));
  } else
#endif
    fill_centers(axis->shape, first, begin, end, in_full(sigma));
  for (int k = begin; k < end; k += 8) {
    const double8 d = first + (double)k + ramp_of_eight();
    const double8 shape = vload8(0, axis->shape + k);
    vstore8(select(shape, (double8)(0.0), fabs(d) > reach), 0, axis->shape + k);
#ifdef KERNEL_CUT
    vstore8((d * squeeze) * (d * squeeze), 0, axis->square + k);
    vstore8((d > -0.5) & (d <= 0.5), 0, axis->holds + k);
#endif
  }
}

// Eight pixels of a row, zero outside the cut.
inline double8 cut_shape(double8 shape, const Axis* columns, int x, const Axis* rows, int y,
                         double cut_square) {
#ifdef KERNEL_CUT
  long8 inside = vload8(0, columns->square + x) + rows->square[y] <= cut_square;
#ifdef SAMPLING_MEAN
  inside |= vload8(0, columns->holds + x) & (long8)(rows->holds[y]);
#endif
  return select((double8)(0.0), shape, inside);
#else
  return shape;
#endif
}

// The product of one along x and one along y.
typedef struct ExtendedShape {
  PixelRange columns, rows;
  Axis along_x, along_y;
  double cut_square;
} ExtendedShape;

// Whether the splat reaches the tile.
inline int start_shape(ExtendedShape* shape, const ExtendedSplat* splat,
                       const ExtendedTile* of_tile) {
#ifdef ELLIPSES
  const double squeeze = in_full(splat->sigma) / in_full(splat->along_x.sigma);
#else
  const double squeeze = 1.0;
#endif
  fill_axis(&shape->along_x, of_tile->corner_x, TILE_WIDTH, splat->x, SIGMA_X(*splat),
            RADIUS_X(*splat), squeeze);
  shape->columns = shape->along_x.range;
  if (shape->columns.first > shape->columns.last) return 0;
  fill_axis(&shape->along_y, of_tile->corner_y, TILE_HEIGHT, splat->y, splat->sigma, splat->radius,
            1.0);
  shape->rows = shape->along_y.range;
  const double cut = in_full(splat->cut);
  shape->cut_square = cut * cut;
  return shape->rows.first <= shape->rows.last;
}

inline double8 shape_of_eight(const ExtendedShape* shape, int x, int y) {
  return cut_shape(vload8(0, shape->along_x.shape + x) * shape->along_y.shape[y], &shape->along_x,
                   x, &shape->along_y, y, shape->cut_square);
}
#endif
