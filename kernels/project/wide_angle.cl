// Where the projections that look in all directions put a particle (docs/projections.md), on
// VALUEs (lanes.cl). Directions are unit vectors, so that no square leaves single precision.
#include "kernels/common/lanes.cl"
#include "kernels/project/project.h"

#pragma OPENCL FP_CONTRACT OFF

typedef struct WideAnglePoint {
  VALUE x, y;                         // pixels from the middle of the picture
  VALUE scale;                        // pixels per length of a cloud's width
  VALUE cos_latitude, sine_latitude;  // equirectangular
  VALUE magnification;                // of directions in the picture, but for a panorama's along x
  INTEGER seen;
} WideAnglePoint;

// Turned about the head's axis, as an eye beside the camera sees it (Rodrigues' formula).
static inline void turn(VALUE* x, VALUE* y, VALUE* z, VALUE sine, const float* axis) {
  const VALUE cosine = sqrt(max(1.0f - sine * sine, (VALUE)(0.0f)));
  const VALUE along = (*x * axis[0] + *y * axis[1] + *z * axis[2]) * (1.0f - cosine);
  const VALUE turned_x = *x * cosine + (axis[1] * *z - axis[2] * *y) * sine + axis[0] * along;
  const VALUE turned_y = *y * cosine + (axis[2] * *x - axis[0] * *z) * sine + axis[1] * along;
  const VALUE turned_z = *z * cosine + (axis[0] * *y - axis[1] * *x) * sine + axis[2] * along;
  *x = turned_x;
  *y = turned_y;
  *z = turned_z;
}

// x right, y down, z forward, in lengths.
static inline WideAnglePoint project_wide_angle(VALUE x, VALUE y, VALUE z, VALUE distance,
                                                const ProjectParameters p) {
  WideAnglePoint point;
  x /= distance;
  y /= distance;
  z /= distance;
  point.seen = distance > 0.0f & distance <= FLT_MAX;
  if (p.eye_offset != 0.0f) {
    const VALUE sine = p.eye_offset / distance;
    point.seen &= fabs(sine) < 1.0f;
    turn(&x, &y, &z, sine, p.turn_axis);
  }
  const float focal = p.pixels_per_length;
  point.scale = focal / distance;
  point.cos_latitude = point.magnification = (VALUE)(1.0f);
  point.sine_latitude = y;
  if (PROJECTION_FISHEYE) {
    const VALUE sine_off_axis = sqrt(x * x + y * y);
    const VALUE angle = atan2(sine_off_axis, z);
    const INTEGER off_axis = sine_off_axis > 0.0f;
    const VALUE per_sine = focal * angle / max(sine_off_axis, (VALUE)(FLT_MIN));
    point.magnification = max(angle / max(sine_off_axis, (VALUE)(FLT_MIN)), (VALUE)(1.0f));
    point.x = choose(focal * angle, x * per_sine, off_axis);
    point.y = choose((VALUE)(0.0f), y * per_sine, off_axis);
    // A cloud keeps its solid angle; right behind the camera it grows no wider.
    const VALUE least_sine = choose((VALUE)(0.1f), (VALUE)(0.0f), z > 0.0f);
    const VALUE widening = angle / max(max(sine_off_axis, least_sine), (VALUE)(FLT_MIN));
    point.scale *= sqrt(choose((VALUE)(1.0f), widening, sine_off_axis > 1e-6f | z <= 0.0f));
  } else if (PROJECTION_EQUIRECTANGULAR) {
    point.cos_latitude = sqrt(x * x + z * z);
    point.x = focal * atan2(x, z);
    point.y = focal * atan2(y, point.cos_latitude);
  } else {
    // What is nearly beside the camera has no light in the face (src/scene/projection.cpp).
    point.x = focal * x / z;
    point.y = focal * y / z;
    point.scale /= max(z, (VALUE)(SMALLEST_COSINE_OF_FACE));
    point.magnification = 1.0f / max(z * z, (VALUE)(FLT_MIN));
    point.seen &= z > SMALLEST_COSINE_OF_FACE;
  }
  return point;
}

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
  const VALUE k = 0.5f + 0.773239545f / (1.0f + u2 * (3.09f - 1.8f / (1.0f + 0.5f * u2)));
  const VALUE root = sqrt(u2 + k), m = u2 / root;
  const VALUE sine_m = cos_latitude * per_s * (u / root);
  PanoramaEllipse ellipse;
  ellipse.nearer = sigma * (u * k / (root * (root + u)));
  ellipse.sigma_x =
      1.77245385f * p.pixels_per_length / (sine * exp(-m * m) + 1.77245385f * sine_m * erf(m));
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
  const float half_period = 0.5f * p.period;
  const float most = (float)MOST_HALF_PERIODS;
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
