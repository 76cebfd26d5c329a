// How wide LANES splats are and what they weigh, in the picture's pixels, and which of them may be
// seen.
#include "kernels/common/common.cl"
#include "kernels/common/lanes.cl"
#include "kernels/project/face_ellipse.cl"
#include "kernels/project/limits.cl"
#include "kernels/project/load.cl"
#include "kernels/project/project.h"
#include "kernels/project/splat_place.cl"
#include "kernels/project/view.cl"
#include "kernels/project/wide_angle.cl"

#pragma OPENCL FP_CONTRACT OFF

typedef struct SplatLanes {
  INTEGER visible, bad;
  INTEGER unclear;  // of the visible: those of which depth keys decide whether they are
  INTEGER too_sharp;
#ifdef CLOUDS_AROUND
  INTEGER around;  // good ones around the camera, which are neither visible nor too sharp
#endif
  INTEGER grid;
  VALUE x, y;  // pixels of the grid from its middle
  PlaceLanes place;
  INTEGER component_and_grid;  // as in Splat
  VALUE farthest_shown;        // pixels of the grid beyond which nothing of the splat shows
  VALUE sigma, radius, weight, color;
#ifdef ELLIPSES
  VALUE sigma_x, radius_x;
#endif
#ifdef FACE_OF_CUBE
  FaceEllipse face;
  VALUE farther, part;  // face_reach(), face_part()
#endif
#ifdef VECTOR_COLORS
  Vectors own_color;
#endif
  VALUE sort_field;
} SplatLanes;

// Widths in the picture's pixels, before any pixel mean is taken.
typedef struct WidthLanes {
  VALUE h;                  // in lengths
  VALUE sigma_true, sigma;  // without and with kernel.min_radius and NARROWEST_SIGMA
#ifdef COPIES
  VALUE sigma_x;
  VALUE nearer;  // by which it lies nearer to the pole
#endif
#ifdef FACE_OF_CUBE
  FaceEllipse face;
  VALUE part;  // face_part()
#endif
} WidthLanes;

// As they are drawn, along y and x, and of the narrower side.
#ifdef FACE_OF_CUBE
#define DRAWN_SIGMA(widths) ((widths).face.sigma_y)
#define DRAWN_SIGMA_X(widths) ((widths).face.sigma_x)
#define NARROW_SIGMA(widths) ((widths).face.narrow)
#else
#define DRAWN_SIGMA(widths) ((widths).sigma)
#define DRAWN_SIGMA_X(widths) ((widths).sigma_x)
#define NARROW_SIGMA(widths) ((widths).sigma)
#endif

INLINED WidthLanes find_widths(VALUE raw_h, const ViewLanes view, const ProjectParameters p) {
  WidthLanes widths;
  widths.h = raw_h * p.size_factor;
  widths.sigma_true = p.sigma_per_h * raw_h * view.scale;
  const float sigma_floor = p.kernel_width * p.min_radius;
  const VALUE sigma = p.min_radius > 0.0f
                          ? sqrt(widths.sigma_true * widths.sigma_true + sigma_floor * sigma_floor)
                          : widths.sigma_true;
  widths.sigma = max(sigma, (VALUE)(NARROWEST_SIGMA));
#ifdef FACE_OF_CUBE
  const float per_focal = 1.0f / p.pixels_per_length;
  widths.face = face_ellipse(widths.sigma, (view.x - p.center_x) * per_focal,
                             (view.y - p.center_y) * per_focal, p);
  widths.part = face_part(widths.face, (VALUE)(p.reach), p);
#endif
#ifdef COPIES
  const PanoramaEllipse ellipse =
      panorama_ellipse(widths.sigma, view.cos_latitude, view.sine_latitude, p);
  widths.sigma_x = ellipse.sigma_x;
  widths.nearer = ellipse.nearer;
#endif
  return widths;
}

// Where a splat of these widths lies. What the sum rounds off goes to the low part.
INLINED ViewLanes place_of_splat(ViewLanes view, const WidthLanes widths) {
#ifdef COPIES
  const VALUE shift = copysign(widths.nearer, view.sine_latitude), y = view.y + shift;
  const VALUE added = y - view.y;
  view.y_low += (view.y - (y - added)) + (shift - added);
  view.y = y;
#endif
  return view;
}

// w of a splat of width widths.sigma, before its intensity.
INLINED VALUE find_weight(VALUE raw, const ViewLanes view, const WidthLanes widths,
                          const ProjectParameters p) {
  if (p.min_radius > 0.0f) {
    // The radius cancels out.
    if (p.weight_model == WEIGHT_CONSTANT) {
      return raw * (p.weight_scale * (p.kernel_width / p.length_scale)) *
             (view.scale / widths.sigma);
    }
    return column_weight(raw, widths.h, p) * (widths.sigma_true / widths.sigma);
  }
  const INTEGER narrow = widths.sigma_true < NARROWEST_SIGMA;
  if (!ANY(narrow)) return column_weight(raw, widths.h, p);
  const VALUE widened = NARROWEST_SIGMA / (p.kernel_width * view.scale);
  const VALUE weight = column_weight(raw, choose(widths.h, widened, narrow), p);
  const VALUE inverse_widening = widths.sigma_true * (1.0f / NARROWEST_SIGMA);
  return choose(weight, weight_of_widened(weight, inverse_widening, p), narrow);
}

// Rejection before fields are scaled. It never leaves out what a grid would show: a crop has the
// picture's splats.
INLINED INTEGER may_be_seen(const ViewLanes view, const WidthLanes widths,
                            const ProjectParameters p) {
#ifdef FACE_OF_CUBE
  const VALUE farther = face_reach(widths.face, (VALUE)(p.reach), p);
#else
  const float farther = 1.0f;
#endif
  const VALUE reach = p.reach * DRAWN_SIGMA(widths) * farther + 2.0f;
  INTEGER seen = (view.y + reach >= p.seen_top) & (view.y - reach <= p.seen_bottom);
#ifdef WIDE_ANGLE
  seen &= view.seen;
#endif
#ifdef FACE_OF_CUBE
  const VALUE reach_x = p.reach * DRAWN_SIGMA_X(widths) * farther + 2.0f;
#else
  const VALUE reach_x = reach;
#endif
#ifndef COPIES  // beside the picture they may reach it
  seen &= view.x + reach_x >= p.seen_left & view.x - reach_x <= p.seen_right_end;
#endif
  return seen;
}
