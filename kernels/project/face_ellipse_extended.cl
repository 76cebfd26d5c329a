// How a cloud lies on a face of a cube, in extended numbers; face_ellipse.cl has the same in single
// precision.
#include "kernels/extended/extended.cl"
#include "kernels/project/project.h"

#pragma OPENCL FP_CONTRACT OFF

typedef struct ExtendedFaceEllipse {
  Extended squared_width, footprint, secant2;
  // Single precision serves for what follows.
  float sigma_x, sigma_y, wide;
} ExtendedFaceEllipse;

static inline Extended extended_face_footprint(Extended squared_width, const ProjectParameters p,
                                               const ExtendedParameters e) {
  if (!(p.footprint > 0.0f)) return extended_of(0.0f);
  const Extended one = extended_of(1.0f);
  const Extended sixth = extended_constant(1.666666716e-01f, -4.967053879e-09f);
  const Extended to_narrowest = extended_difference(extended_scaled(sixth, 4.0f), squared_width);
  const Extended of_pixel = extended_less(sixth, to_narrowest) ? to_narrowest : sixth;
  const Extended angle =
      extended_quotient(extended_root(squared_width), extended_pair(e.pixels_per_length));
  const Extended u = extended_difference(extended_product(extended_of(24.0f), angle), one);
  if (high_part(u) <= 0.0f) return of_pixel;
  if (high_part(u) >= 1.0f) return extended_of(0.0f);
  const Extended rising = extended_difference(extended_of(3.0f), extended_scaled(u, 2.0f));
  const Extended faded = extended_product(extended_product(u, u), rising);
  return extended_product(of_pixel, extended_difference(one, faded));
}

// Of a cloud at (x, y) pixels from the face's middle; `sigma` as extended_wide_angle() has it.
static inline ExtendedFaceEllipse extended_face_ellipse(Extended sigma, Extended x, Extended y,
                                                        const ProjectParameters p,
                                                        const ExtendedParameters e) {
  const Extended focal = extended_pair(e.pixels_per_length);
  x = extended_quotient(x, focal);
  y = extended_quotient(y, focal);
  ExtendedFaceEllipse ellipse;
  ellipse.secant2 =
      extended_sum(extended_of(1.0f), extended_sum(extended_product(x, x), extended_product(y, y)));
  ellipse.squared_width = extended_quotient(extended_product(sigma, sigma), ellipse.secant2);
  ellipse.footprint = extended_face_footprint(ellipse.squared_width, p, e);
  const float across = high_part(sigma) * high_part(sigma) + high_part(ellipse.footprint);
  ellipse.sigma_x = sqrt(across * (1.0f + high_part(x) * high_part(x)));
  ellipse.sigma_y = sqrt(across * (1.0f + high_part(y) * high_part(y)));
  ellipse.wide = sqrt(across * high_part(ellipse.secant2));
  return ellipse;
}

static inline float extended_face_reach(const ExtendedFaceEllipse ellipse, float extent,
                                        const ProjectParameters p) {
  const float g = high_part(ellipse.squared_width), c = high_part(ellipse.footprint);
  const float own = high_part(ellipse.secant2);
  const float way = extent * ellipse.wide / (p.pixels_per_length * sqrt(own));
  const float to_here = 1.0f - min(way, 0.999f);
  return sqrt((g * min(own / (to_here * to_here), 3.0f) + c) / (g * own + c));
}

// What any pixel shows of the cloud's own peak, at most.
static inline float extended_face_part(const ExtendedFaceEllipse ellipse) {
  const float gk = 3.0f * high_part(ellipse.squared_width), c = high_part(ellipse.footprint);
  return c > 0.0f ? gk / (gk + c) : 1.0f;
}
