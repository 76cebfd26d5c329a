// Where the projections that look in all directions put a particle (docs/projections.md), on
// VALUEs (lanes.cl, exact_point.cl). Directions are unit vectors, so that no square leaves single
// precision.
#include "kernels/common/common.cl"
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
static inline void turn(VALUE* x, VALUE* y, VALUE* z, VALUE sine, const REAL* axis) {
  const VALUE cosine = sqrt(max(1.0f - sine * sine, (VALUE)(0.0f)));
  const VALUE along = (*x * axis[0] + *y * axis[1] + *z * axis[2]) * (1.0f - cosine);
  const VALUE turned_x = *x * cosine + (axis[1] * *z - axis[2] * *y) * sine + axis[0] * along;
  const VALUE turned_y = *y * cosine + (axis[2] * *x - axis[0] * *z) * sine + axis[1] * along;
  const VALUE turned_z = *z * cosine + (axis[0] * *y - axis[1] * *x) * sine + axis[2] * along;
  *x = turned_x;
  *y = turned_y;
  *z = turned_z;
}

// Less off the axis than this, a direction is taken for one to the right
// (src/scene/projection.cpp).
#define SINE_ON_AXIS 0x1p-40f

// x right, y down, z forward, in lengths.
static inline WideAnglePoint project_wide_angle(VALUE x, VALUE y, VALUE z, VALUE distance,
                                                REAL focal, REAL eye_offset,
                                                const REAL* turn_axis) {
  WideAnglePoint point;
  x /= distance;
  y /= distance;
  z /= distance;
  point.seen = distance > 0.0f & distance <= FLT_MAX;
  if (eye_offset != 0.0f) {
    const VALUE sine = eye_offset / distance;
    point.seen &= fabs(sine) < 1.0f;
    turn(&x, &y, &z, sine, turn_axis);
  }
  point.scale = focal / distance;
  point.cos_latitude = point.magnification = (VALUE)(1.0f);
  point.sine_latitude = y;
  if (PROJECTION_FISHEYE) {
    const VALUE sine_off_axis = sqrt(x * x + y * y);
    const VALUE angle = atan2(sine_off_axis, z);
    const INTEGER off_axis = sine_off_axis > SINE_ON_AXIS;
    const VALUE per_sine = focal * angle / max(sine_off_axis, (VALUE)(FLT_MIN));
    point.magnification = max(angle / max(sine_off_axis, (VALUE)(FLT_MIN)), (VALUE)(1.0f));
    point.x = choose(focal * angle, x * per_sine, off_axis);
    point.y = choose((VALUE)(0.0f), y * per_sine, off_axis);
    // A cloud keeps its solid angle; right behind the camera it grows no wider.
    const VALUE least_sine = choose((VALUE)(REAL_OF(0.1)), (VALUE)(0.0f), z > 0.0f);
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
