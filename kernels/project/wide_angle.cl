// Ellipses and copies of splats in panoramas (docs/projections.md), on VALUEs (lanes.cl).
#include "kernels/common/lanes.cl"
#include "kernels/project/project.h"

#pragma OPENCL FP_CONTRACT OFF

// The ellipse as which an equirectangular picture shows a cloud of this height: panorama_ellipse()
// of src/scene/projection.cpp.
typedef struct PanoramaEllipse {
  VALUE nearer;  // pixels by which it is shifted towards the pole
  VALUE sigma_x;
} PanoramaEllipse;

static inline PanoramaEllipse panorama_ellipse(VALUE sigma, VALUE cos_latitude, VALUE sine_latitude,
                                               const ProjectParameters p) {
  const VALUE per_s = p.pixels_per_length / sigma;
  const VALUE sine = max(fabs(sine_latitude), (VALUE)(1e-18f));
  const VALUE u = min(cos_latitude * per_s / sine, (VALUE)(1e15f)), u2 = u * u;
  const VALUE k = 0.5f + REAL_OF(0.77323954473516276) /
                             (1.0f + u2 * (REAL_OF(3.09) - REAL_OF(1.8) / (1.0f + 0.5f * u2)));
  const VALUE root = sqrt(u2 + k), m = u2 / root;
  const VALUE sine_m = cos_latitude * per_s * (u / root);
  PanoramaEllipse ellipse;
  ellipse.nearer = sigma * (u * k / (root * (root + u)));
  ellipse.sigma_x = REAL_OF(1.7724538509055161) * p.pixels_per_length /
                    (sine * exp(-m * m) + REAL_OF(1.7724538509055161) * sine_m * erf(m));
  return ellipse;
}

// A value of one of both poles. With an index all parameters would be copied to memory.
#define OF_POLE(values, pole) ((pole) != 0 ? (values)[1] : (values)[0])

// One copy of a splat: so many half periods to the right. Odd ones are mirrored over a pole, 1 is
// the lower one.
typedef struct Copy {
  int half_periods, pole;
} Copy;

// Those that reach what is drawn, by their number: of each period one that is not mirrored, and
// those over the poles from which light comes back, one or both.
typedef struct Copies {
  int first, last, mirrored, pole;
} Copies;

// The seventh is beyond what any cloud has light for: none is wider than WIDEST_ANGLE.
#define MOST_HALF_PERIODS 6
#define WIDEST_ANGLE 2.0f

INLINED Copies one_copy(void) {
  Copies copies;
  copies.first = copies.last = copies.mirrored = copies.pole = 0;
  return copies;
}

INLINED int is_over_pole(int pole, float y, float radius, const ProjectParameters p) {
  const float mirrored = OF_POLE(p.twice_pole, pole) - y;
  return mirrored + radius + 1.0f >= p.top && mirrored - radius - 1.0f <= p.bottom;
}

static inline Copies copies_in_picture(float x, float y, float radius_x, float radius,
                                       const ProjectParameters p) {
  const REAL half_period = 0.5f * p.period;
  const REAL most = (REAL)MOST_HALF_PERIODS;
  // A pixel more, so that a crop has no fewer for roundings.
  radius_x += 1.0f;
  const int first = (int)clamp(ceil((p.left - radius_x - x) / half_period), -most, most + 1.0f);
  const int last =
      (int)clamp(floor((p.right_end + radius_x - x) / half_period), -most - 1.0f, most);
  const int over_upper = is_over_pole(0, y, radius, p), over_lower = is_over_pole(1, y, radius, p);
  Copies copies;
  copies.mirrored = over_upper + over_lower;
  copies.pole = over_upper == 0;
  copies.first = (first >> 1) * (1 + copies.mirrored) + (first & 1);
  copies.last = (last >> 1) * (1 + copies.mirrored) + (last & 1) * copies.mirrored;
  return copies;
}

INLINED Copy copy_of_number(int number, const Copies copies) {
  const int of_period = 1 + copies.mirrored;
  const int period = (number + MOST_HALF_PERIODS * of_period) / of_period - MOST_HALF_PERIODS;
  const int over = number - period * of_period;
  Copy copy;
  copy.half_periods = 2 * period + (over > 0);
  copy.pole = copies.mirrored == 2 ? over - 1 : copies.pole;
  return copy;
}
