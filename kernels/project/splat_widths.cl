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
  INTEGER around;  // good ones around the camera, which are neither visible nor too sharp
  INTEGER grid;
  VALUE x, y;  // pixels of the grid from its middle
  PlaceLanes place;
  INTEGER component_and_grid;  // as in Splat
  VALUE farthest_shown;        // pixels of the grid beyond which nothing of the splat shows
  VALUE sigma, radius, weight, color;
  VALUE sigma_x, radius_x;  // of ellipses
  FaceEllipse face;         // on a face of a cube
  VALUE farther, part;      // face_reach(), face_part()
  Vectors own_color;
  VALUE sort_field;
} SplatLanes;

// Widths in the picture's pixels, before any pixel mean is taken.
typedef struct WidthLanes {
  VALUE h;  // in lengths
  // Without and with kernel.min_radius, kernel.footprint, a lens and NARROWEST_SIGMA.
  VALUE sigma_true, sigma;
  VALUE sigma_weighed;  // the same, before panoramas keep it from being wider than WIDEST_ANGLE
  VALUE sigma_x;        // of a panorama
  VALUE nearer;         // by which it lies nearer to the pole there
  FaceEllipse face;     // on a face of a cube
  VALUE part;           // face_part()
} WidthLanes;

// As they are drawn, along y and x, and of the narrower side.
INLINED VALUE drawn_sigma(const WidthLanes widths) {
  return FACE_OF_CUBE ? widths.face.sigma_y : widths.sigma;
}
INLINED VALUE drawn_sigma_x(const WidthLanes widths) {
  if (FACE_OF_CUBE) return widths.face.sigma_x;
  return ELLIPSES ? widths.sigma_x : widths.sigma;
}
INLINED VALUE narrow_sigma(const WidthLanes widths) {
  return FACE_OF_CUBE ? widths.face.narrow : widths.sigma;
}

INLINED WidthLanes find_widths(VALUE raw_h, const ViewLanes view, const ProjectParameters p) {
  WidthLanes widths;
  widths.h = raw_h * p.size_factor;
  widths.sigma_true = p.sigma_per_h * raw_h * view.scale;
  const REAL widened_by = max(p.kernel_width * p.min_radius, p.footprint_sigma);  // one is 0
  VALUE sigma = widened_by > 0.0f
                    ? sqrt(widths.sigma_true * widths.sigma_true + widened_by * widened_by)
                    : widths.sigma_true;
  if (p.lens_sigma > 0.0f) {
    const VALUE of_lens = p.lens_sigma * (view.scale - p.scale_in_focus);
    sigma = sqrt(sigma * sigma + of_lens * of_lens);
  }
  widths.sigma = widths.sigma_weighed = max(sigma, (VALUE)(NARROWEST_SIGMA));
  if (FACE_OF_CUBE) {
    const REAL per_focal = 1.0f / p.pixels_per_length;
    widths.face = face_ellipse(widths.sigma, (view.x - p.center_x) * per_focal,
                               (view.y - p.center_y) * per_focal, p);
    widths.part = face_part(widths.face, (VALUE)(p.reach), p);
  }
  if (COPIES) {
    widths.sigma = min(widths.sigma, (VALUE)(WIDEST_ANGLE * p.pixels_per_length));
    const PanoramaEllipse ellipse =
        panorama_ellipse(widths.sigma, view.cos_latitude, view.sine_latitude, p);
    widths.sigma_x = ellipse.sigma_x;
    widths.nearer = ellipse.nearer;
  }
  return widths;
}

// Where a splat of these widths lies. What the sum rounds off goes to the low part.
INLINED ViewLanes place_of_splat(ViewLanes view, const WidthLanes widths) {
  if (!COPIES) return view;
  const VALUE shift = copysign(widths.nearer, view.sine_latitude), y = view.y + shift;
  const VALUE added = y - view.y;
  view.y_low += (view.y - (y - added)) + (shift - added);
  view.y = y;
  return view;
}

// w of a splat of width widths.sigma, before its intensity.
INLINED VALUE find_weight(VALUE raw, const ViewLanes view, const WidthLanes widths,
                          const ProjectParameters p) {
  if (p.min_radius > 0.0f) {  // without a lens
    // The radius cancels out.
    if (p.weight_model == WEIGHT_CONSTANT) {
      return raw * (p.weight_scale * (p.kernel_width / p.length_scale)) *
             (view.scale / widths.sigma_weighed);
    }
    return column_weight(raw, widths.h, p) * (widths.sigma_true / widths.sigma_weighed);
  }
  if (p.footprint_sigma > 0.0f || p.lens_sigma > 0.0f) {
    const VALUE h = widths.sigma_weighed / (p.kernel_width * view.scale);
    return weight_of_widened(column_weight(raw, h, p), widths.sigma_true / widths.sigma_weighed, p);
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
  VALUE reach = p.reach * drawn_sigma(widths), reach_x = reach;
  if (FACE_OF_CUBE) {
    const VALUE farther = face_reach(widths.face, (VALUE)(p.reach), p);
    reach *= farther;
    reach_x = p.reach * drawn_sigma_x(widths) * farther;
  }
  reach += 2.0f;
  reach_x += 2.0f;
  INTEGER seen = (view.y + reach >= p.seen_top) & (view.y - reach <= p.seen_bottom);
  if (WIDE_ANGLE) seen &= view.seen;
  // Copies of what is beside the picture may reach it.
  if (COPIES) return seen;
  return seen & (view.x + reach_x >= p.seen_left & view.x - reach_x <= p.seen_right_end);
}
