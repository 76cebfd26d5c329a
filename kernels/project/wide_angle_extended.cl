// Where the projections that look in all directions put a particle, in extended numbers
// (docs/projections.md); wide_angle.cl has the same in single precision.
#include "kernels/common/common.cl"
#include "kernels/common/grid.h"
#include "kernels/extended/extended.cl"
#include "kernels/extended/extended_angle.cl"
#include "kernels/project/project.h"

#pragma OPENCL FP_CONTRACT OFF

typedef struct ExtendedWideAngle {
  Extended x, y;                         // pixels from the middle of the picture
  Extended distance;                     // in the lengths of the direction
  Extended scale;                        // pixels per such a length
  Extended cos_latitude, sine_latitude;  // equirectangular
  int seen;
} ExtendedWideAngle;

static inline Extended extended_turned(Extended value, Extended across, Extended along,
                                       Extended sine, Extended cosine) {
  return extended_sum(extended_sum(extended_product(value, cosine), extended_product(across, sine)),
                      along);
}

static inline Extended extended_minor(Extended a, Extended b, Extended c, Extended d) {
  return extended_difference(extended_product(a, d), extended_product(b, c));
}

// A GPU's compiler would put the parameters that a call is handed in memory of each work-item's
// own. Inlined into fisheye projections of work-groups, the turn crashes LLVM 15 for AVX2
// (docs/dev/portability.md).
#ifdef CALLS_TURN
#define TURN __attribute__((noinline)) static
#else
#define TURN INLINED
#endif

// Turned about the head's axis, as an eye beside the camera sees it (Rodrigues' formula).
TURN void extended_turn(Extended* v, Extended sine, const FloatPair* turn_axis) {
  const Extended one = extended_of(1.0f);
  const Extended cosine =
      extended_root(extended_product(extended_difference(one, sine), extended_sum(one, sine)));
  Extended axis[3], turned[3];
  for (int i = 0; i < 3; ++i)
    axis[i] = extended_pair(turn_axis[i]);
  const Extended projected =
      extended_sum(extended_sum(extended_product(v[0], axis[0]), extended_product(v[1], axis[1])),
                   extended_product(v[2], axis[2]));
  const Extended along = extended_product(projected, extended_difference(one, cosine));
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    turned[i] = extended_turned(v[i], extended_minor(axis[j], axis[k], v[j], v[k]),
                                extended_product(axis[i], along), sine, cosine);
  }
  for (int i = 0; i < 3; ++i)
    v[i] = turned[i];
}

// Less off the axis than this part of the distance, a direction is taken for one to the right
// (src/scene/projection.cpp).
#define SINE_ON_AXIS 0x1p-40f

static inline void place_in_fisheye(const Extended* v, Extended focal, ExtendedWideAngle* place) {
  const Extended across = extended_hypotenuse(v[0], v[1]);
  const Extended angle = extended_atan2(across, v[2]);
  const Extended radius = extended_product(focal, angle);
  const int off_axis = high_part(across) > SINE_ON_AXIS * high_part(place->distance);
  place->x = off_axis ? extended_product(extended_quotient(v[0], across), radius) : radius;
  place->y =
      off_axis ? extended_product(extended_quotient(v[1], across), radius) : extended_of(0.0f);
  // A cloud keeps its solid angle; right behind the camera it grows no wider.
  Extended sine = extended_quotient(across, place->distance);
  const Extended least_sine = extended_constant(0.1f, -1.49011612e-09f);
  if (!(high_part(v[2]) > 0.0f) && extended_less(sine, least_sine)) sine = least_sine;
  if (high_part(sine) > 0.0f) {
    place->scale = extended_product(place->scale, extended_root(extended_quotient(angle, sine)));
  }
}

static inline void place_in_panorama(const Extended* v, Extended focal, ExtendedWideAngle* place) {
  const Extended level = extended_hypotenuse(v[0], v[2]);
  place->cos_latitude = extended_quotient(level, place->distance);
  place->sine_latitude = extended_quotient(v[1], place->distance);
  place->x = extended_product(focal, extended_atan2(v[0], v[2]));
  place->y = extended_product(focal, extended_atan2(v[1], level));
}

static inline void place_in_face(const Extended* v, Extended focal, ExtendedWideAngle* place) {
  const Extended cosine = extended_quotient(v[2], place->distance);
  place->seen &= high_part(cosine) > SMALLEST_COSINE_OF_FACE;
  place->x = extended_quotient(extended_product(focal, v[0]), v[2]);
  place->y = extended_quotient(extended_product(focal, v[1]), v[2]);
  place->scale = extended_quotient(place->scale, cosine);
}

// The direction v is right, down, forward; `eye_offset` in the same lengths.
static inline ExtendedWideAngle extended_wide_angle(Extended* v, Extended eye_offset,
                                                    const ExtendedParameters e) {
  ExtendedWideAngle place;
  place.distance = extended_hypotenuse(extended_hypotenuse(v[0], v[2]), v[1]);
  place.seen = high_part(place.distance) > 0.0f && high_part(place.distance) <= FLT_MAX;
  if (high_part(eye_offset) != 0.0f) {
    place.seen &= extended_less(extended_magnitude(eye_offset), place.distance);
    if (place.seen) extended_turn(v, extended_quotient(eye_offset, place.distance), e.turn_axis);
  }
  const Extended focal = extended_pair(e.pixels_per_length);
  place.scale = extended_quotient(focal, place.distance);
  place.cos_latitude = extended_of(1.0f);
  place.sine_latitude = extended_of(0.0f);
  if (PROJECTION_FISHEYE)
    place_in_fisheye(v, focal, &place);
  else if (PROJECTION_EQUIRECTANGULAR)
    place_in_panorama(v, focal, &place);
  else
    place_in_face(v, focal, &place);
  return place;
}

// panorama_ellipse() of wide_angle.cl.
typedef struct ExtendedEllipse {
  Extended nearer, sigma_x;
} ExtendedEllipse;

static inline Extended extended_sum_with(float a, Extended b) {
  return extended_sum(extended_of(a), b);
}

// k of the m at this u^2. Its constants are those of the host, in double precision.
static inline Extended extended_k_of(Extended u2) {
  const Extended one_and_half = extended_sum_with(1.0f, extended_scaled(u2, 0.5f));
  const Extended c = extended_difference(
      extended_constant(3.08999991f, 8.58306883e-08f),
      extended_quotient(extended_constant(1.79999995f, 4.76837159e-08f), one_and_half));
  const Extended falls = extended_quotient(extended_constant(0.773239553f, -8.23953816e-09f),
                                           extended_sum_with(1.0f, extended_product(u2, c)));
  return extended_sum_with(0.5f, falls);
}

// sine * exp(-m^2) + sqrt(pi) sine_m erf(m), relative error 4e-9.
static inline Extended extended_row_length(Extended sine, Extended m, Extended sine_m) {
  const Extended along = extended_product(extended_constant(1.7724539f, -5.32464006e-08f), sine_m);
  if (high_part(m) > 9.0f) return along;
  const Extended gauss = extended_exp(extended_negative(extended_product(m, m)));
  const Extended erf = extended_difference(extended_of(1.0f), extended_erfc(m));
  return extended_sum(extended_product(sine, gauss), extended_product(along, erf));
}

static inline ExtendedEllipse extended_panorama_ellipse(Extended sigma, Extended cos_latitude,
                                                        Extended sine_latitude,
                                                        const ExtendedParameters e) {
  const Extended focal = extended_pair(e.pixels_per_length);
  const Extended level = extended_quotient(extended_product(cos_latitude, focal), sigma);
  Extended sine = extended_magnitude(sine_latitude);
  if (high_part(sine) < 1e-18f) sine = extended_of(1e-18f);
  Extended u = extended_quotient(level, sine);
  if (!(high_part(u) < 1e15f)) u = extended_of(1e15f);
  const Extended u2 = extended_product(u, u), k = extended_k_of(u2);
  const Extended root = extended_root(extended_sum(u2, k));
  ExtendedEllipse ellipse;
  ellipse.nearer = extended_product(
      sigma,
      extended_quotient(extended_product(u, k), extended_product(root, extended_sum(root, u))));
  const Extended sine_m = extended_product(level, extended_quotient(u, root));
  ellipse.sigma_x =
      extended_quotient(extended_product(extended_constant(1.7724539f, -5.32464006e-08f), focal),
                        extended_row_length(sine, extended_quotient(u2, root), sine_m));
  return ellipse;
}
