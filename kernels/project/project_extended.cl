// The projection of one particle in extended numbers (extended.cl). Fields are
// those of project.cl, which finds the bad particles, those beyond the limits and the sort keys.
#include "kernels/common/common.cl"
#include "kernels/common/ellipse.h"
#include "kernels/common/splat.h"
#include "kernels/extended/extended.cl"
#include "kernels/extended/extended_splat.h"
#include "kernels/project/depth_fade.cl"
#include "kernels/project/face_ellipse_extended.cl"
#include "kernels/project/load.cl"
#include "kernels/project/place_extended.cl"
#include "kernels/project/project.h"
#include "kernels/project/splat_place.cl"
#include "kernels/project/wide_angle.cl"
#include "kernels/project/wide_angle_extended.cl"

#pragma OPENCL FP_CONTRACT OFF

// As log_from_least() and asinh_from_least() do it for lanes (limits.cl).
static inline Extended extended_log_from_least(Extended value, const ExtendedFieldScaling map) {
  const Extended above = extended_difference(value, extended_pair(map.minimum));
  if (!(high_part(above) > 0.0f)) return extended_of(0.0f);
  return extended_log_of_one_more(extended_product(above, extended_pair(map.factor)));
}

static inline Extended extended_asinh_from_least(float value, const ExtendedFieldScaling map) {
  const Extended v = extended_of(clamp(value, -1e18f, 1e18f)), m = extended_pair(map.minimum);
  const Extended root = extended_root(extended_sum(extended_of(1.0f), extended_product(v, v)));
  const Extended from_v = extended_product(v, extended_pair(map.factor));
  const Extended from_m = extended_product(m, root);
  if (!(high_part(v) * high_part(m) > 0.0f))
    return extended_asinh(extended_difference(from_v, from_m));
  const Extended part = extended_quotient(extended_sum(v, m), extended_sum(from_v, from_m));
  return extended_asinh(extended_product(extended_difference(v, m), part));
}

// log10 or asinh of a value, or the value itself.
static inline Extended extended_scaled_field(float value, int scaling) {
  if (scaling == SCALING_LOG) {
    const Extended per_ln10 = extended_constant(4.342944920e-01f, -1.010304995e-08f);
    return extended_product(extended_log(extended_of(value)), per_ln10);
  }
  return scaling == SCALING_ASINH ? extended_asinh(extended_of(value)) : extended_of(value);
}

// In [0, 1] (frame.h, ScalarMap).
static inline Extended extended_normalized(float value, int scaling,
                                           const ExtendedFieldScaling map) {
  const int is_log = scaling == SCALING_LOG || scaling == SCALING_LOG_FROM_LEAST;
  if (!isfinite(value) || (is_log && !(value > 0.0f))) return extended_of(0.0f);
  Extended above;
  if (scaling == SCALING_LOG_FROM_LEAST) {
    above = extended_log_from_least(extended_of(value), map);
  } else if (scaling == SCALING_ASINH_FROM_LEAST) {
    above = extended_asinh_from_least(value, map);
  } else {
    above = extended_difference(extended_scaled_field(value, scaling), extended_pair(map.minimum));
  }
  const Extended place = extended_product(above, extended_pair(map.inverse_range));
  if (!(high_part(place) > 0.0f)) return extended_of(0.0f);
  return high_part(place) >= 1.0f ? extended_of(1.0f) : place;
}

// w (scene.h, WeightModel), with sigma in world units; weight_scale as in project.cl.
static inline Extended extended_column(float raw, Extended h, const ProjectParameters p,
                                       const ExtendedParameters e) {
  const Extended scale = extended_pair(e.weight_scale);
  const Extended length_scale = extended_of(p.length_scale);
  Extended sigma_scaled =
      extended_product(extended_product(extended_pair(e.kernel_width), h), length_scale);
  if (!(high_part(sigma_scaled) > FLT_MIN)) sigma_scaled = extended_of(FLT_MIN);
  if (p.weight_model == WEIGHT_MASS) {
    const Extended once =
        extended_quotient(extended_product(extended_of(raw), scale), sigma_scaled);
    return extended_quotient(extended_product(once, scale), sigma_scaled);
  }
  if (p.weight_model == WEIGHT_DENSITY) {
    return extended_product(extended_product(extended_of(raw), scale), sigma_scaled);
  }
  return extended_quotient(extended_product(extended_of(raw), scale),
                           extended_product(h, length_scale));
}

// As weight_of_widened() and limited_weight() do it for lanes.
static inline Extended extended_weight_of_widened(Extended weight, Extended inverse_widening,
                                                  const ProjectParameters p) {
  if (p.weight_model == WEIGHT_MASS) return weight;
  const Extended lowered = extended_product(weight, inverse_widening);
  if (p.weight_model == WEIGHT_CONSTANT) return lowered;
  return extended_product(extended_product(lowered, inverse_widening), inverse_widening);
}
static inline Extended extended_limited_weight(Extended weight, float peak) {
  const float most = min(MOST_LIGHT / max(peak, FLT_MIN), FLT_MAX);
  return high_part(weight) < most ? weight : extended_of(most);
}

// Width in pixels and w, before its intensity; `scale` is pixels per length.
static inline void extended_width(float raw, Extended h, Extended scale, const ProjectParameters p,
                                  const ExtendedParameters e, Extended* sigma, Extended* weight) {
  const Extended width = extended_pair(e.kernel_width);
  const Extended h_pixels = extended_product(h, scale);
  *sigma = extended_product(width, h_pixels);
  if (p.min_radius > 0.0f) {  // without a lens
    const Extended least = extended_pair(e.min_radius);
    const Extended h_drawn = extended_root(
        extended_sum(extended_product(h_pixels, h_pixels), extended_product(least, least)));
    *weight = extended_product(extended_column(raw, h, p, e), extended_quotient(h_pixels, h_drawn));
    *sigma = extended_product(width, h_drawn);
  } else if (p.footprint_sigma > 0.0f || p.lens_sigma > 0.0f ||
             high_part(*sigma) < NARROWEST_EXTENDED_SIGMA) {
    const Extended footprint = extended_pair(e.footprint_sigma);
    Extended drawn = extended_root(
        extended_sum(extended_product(*sigma, *sigma), extended_product(footprint, footprint)));
    if (p.lens_sigma > 0.0f) {
      const Extended of_lens = extended_product(
          extended_pair(e.lens_sigma), extended_difference(scale, extended_pair(e.scale_in_focus)));
      drawn = extended_root(
          extended_sum(extended_product(drawn, drawn), extended_product(of_lens, of_lens)));
    }
    if (high_part(drawn) < NARROWEST_EXTENDED_SIGMA) drawn = extended_of(NARROWEST_EXTENDED_SIGMA);
    const Extended widened = extended_quotient(drawn, extended_product(width, scale));
    *weight = extended_weight_of_widened(extended_column(raw, widened, p, e),
                                         extended_quotient(*sigma, drawn), p);
    *sigma = drawn;
  } else {
    *weight = extended_column(raw, h, p, e);
  }
}

static inline Extended extended_rising(Extended part) {
  if (!(high_part(part) > 0.0f)) return extended_of(0.0f);
  if (high_part(part) >= 1.0f) return extended_of(1.0f);
  const Extended slope = extended_difference(extended_of(3.0f), extended_scaled(part, 2.0f));
  return extended_product(extended_product(part, part), slope);
}
// As part_after_fade() does it for lanes.
static inline Extended extended_after_fade(Extended weight, Extended depth,
                                           const ProjectParameters p, const ExtendedParameters e) {
  if (p.inverse_near_fade > 0.0f) {
    const Extended risen = extended_difference(depth, extended_pair(e.fade_begin));
    weight = extended_product(
        weight, extended_rising(extended_product(risen, extended_pair(e.inverse_near_fade))));
  }
  if (p.inverse_far_fade > 0.0f) {
    const Extended left = extended_difference(extended_pair(e.fade_end), depth);
    weight = extended_product(
        weight, extended_rising(extended_product(left, extended_pair(e.inverse_far_fade))));
  }
  return weight;
}

static inline void extended_knots(__global const float* knots, uint first, uint count,
                                  Extended position, Extended* color) {
  const Extended place = extended_product(position, extended_of((float)(count - 1u)));
  uint below = min((uint)high_part(place), count - 1u);
  // The high part alone may have been rounded up to the next knot.
  if (below > 0u && extended_less(place, extended_of((float)below))) --below;
  const uint above = min(below + 1u, count - 1u);
  const Extended fraction = extended_difference(place, extended_of((float)below));
  __global const float* a = knots + (size_t)(first + below) * KNOT_FLOATS;
  __global const float* b = knots + (size_t)(first + above) * KNOT_FLOATS;
  for (int c = 0; c < 3; ++c) {
    const Extended step = extended_difference(extended_of(b[c]), extended_of(a[c]));
    color[c] = extended_sum(extended_of(a[c]), extended_product(fraction, step));
  }
}

// E w and A w (scene.h, Absorption) at palette position `position`; emission comes with the
// particle's own colour in it.
static inline void extended_amplitudes(Extended position, Extended weight, const Extended* own,
                                       const ComponentColors colors, __global const float* knots,
                                       const ExtendedParameters e, Extended* emission,
                                       Extended* absorption) {
  const Extended bright = extended_product(weight, extended_pair(e.brightness));
  const Extended factor = extended_pair(e.absorption_factor);
  Extended emitted[3], absorbed[3];
  extended_knots(knots, colors.first_knot, colors.knot_count, position, emitted);
  for (int c = 0; c < 3; ++c)
    absorbed[c] = emitted[c] = extended_product(emitted[c], own[c]);
  if (colors.absorption_knot_count > 0) {
    extended_knots(knots, colors.first_absorption_knot, colors.absorption_knot_count, position,
                   absorbed);
  }
  for (int c = 0; c < 3; ++c) {
    emission[c] = extended_product(bright, emitted[c]);
    absorption[c] = extended_product(bright, absorbed[c]);
    if (colors.absorption_kind == ABSORPTION_NONE) absorption[c] = extended_of(0.0f);
    if (colors.absorption_kind == ABSORPTION_FACTOR) {
      absorption[c] = extended_product(extended_product(weight, factor), absorbed[c]);
    }
    if (colors.absorption_kind == ABSORPTION_GRAY) {
      absorption[c] = emission[c];
      if (high_part(emission[c]) > 0.0f) {
        const Extended share = extended_quotient(emission[c], extended_sum(emission[c], factor));
        emission[c] = extended_product(emission[c], share);
      }
    }
  }
}

// How many sigma are drawn so that no sum of all of the frame's splats leaves out more than
// the truncation's share.
static inline float extended_extent(float peak, const ExtendedParameters e) {
  return sqrt(log(max(peak * e.inverse_share, 1.0f))) + 1e-3f;
}

// Tiles are chosen by rounded numbers: with room for that, `far` pixels from the picture's middle.
static inline float rounded_radius(float radius, float far) {
  return radius * 1.000001f + 2e-7f * far;
}

// How far a splat of this width is drawn along one axis.
static inline float radius_of(Extended sigma, float extent, const ExtendedParameters e) {
  const float radius = extent * high_part(sigma);
  const Extended cut = extended_product(extended_pair(e.kernel_cut), sigma);
  const float cut_radius = high_part(cut) * 1.000001f;
  return (e.is_cut ? min(radius, cut_radius) : radius) + e.reach_of_mean;
}

// As splat_place() does for lanes, well enough to choose tiles by.
static inline void put_in_units(float x, float y, float farthest, const ProjectParameters p,
                                Splat* splat) {
  const int exponent = (as_int(max(max(fabs(x), fabs(y)), farthest)) >> 23) - 127;
  const int coarser = max(exponent + p.place_bits - 29, 0);
  const float units_per_pixel = as_float((127 + p.place_bits - coarser) << 23);
  splat->x = (int)(x * units_per_pixel);
  splat->y = (int)(y * units_per_pixel);
  splat->component_and_grid = p.component | ((uint)coarser << 24);
}

static inline ExtendedFaceEllipse ellipse_on_face(const ExtendedPlace place, Extended sigma,
                                                  const ProjectParameters p,
                                                  const ExtendedParameters e) {
  return extended_face_ellipse(sigma, extended_difference(place.x, extended_pair(e.center_x)),
                               extended_difference(place.y, extended_pair(e.center_y)), p, e);
}

// Places and widths; `peak` is the largest of E w and A w.
static inline void extended_shape(ExtendedPlace place, Extended sigma, float peak,
                                  const ProjectParameters p, const ExtendedParameters e,
                                  Splat* splat, ExtendedSplat* extended) {
#if FACE_OF_CUBE
  const ExtendedFaceEllipse ellipse = ellipse_on_face(place, sigma, p, e);
  const Extended sigma_x = extended_of(ellipse.sigma_x), sigma_y = extended_of(ellipse.sigma_y);
  const float area = 1.0f;
#elif ELLIPSES
  const Extended widest = extended_scaled(extended_pair(e.pixels_per_length), WIDEST_ANGLE);
  if (extended_less(widest, sigma)) sigma = widest;
  const ExtendedEllipse ellipse =
      extended_panorama_ellipse(sigma, place.cos_latitude, place.sine_latitude, e);
  const Extended sigma_x = ellipse.sigma_x;
  place.y = high_part(place.sine_latitude) < 0.0f ? extended_difference(place.y, ellipse.nearer)
                                                  : extended_sum(place.y, ellipse.nearer);
  const Extended sigma_y = sigma;
  const float area = high_part(sigma) * high_part(sigma_x);
#else
  const Extended sigma_y = sigma;
  const float area = high_part(sigma) * high_part(sigma);
#endif
  // The flux, not the peak, limits what a grain below a pixel can do to a pixel.
  const float extent = extended_extent(peak * min(1.0f, 3.2f * area), e);
  extended->x = pair_of(place.x);
  extended->y = pair_of(place.y);
#if FACE_OF_CUBE
  const float farther = extended_face_reach(ellipse, extent, p);
  extended->cut = e.kernel_cut;
  extended->tilt.squared_width = pair_of(ellipse.squared_width);
  extended->tilt.footprint = pair_of(ellipse.footprint);
  extended->tilt.inverse_secant2 = pair_of(extended_quotient(extended_of(1.0f), ellipse.secant2));
#else
  const float farther = 1.0f;
  extended->cut = pair_of(extended_product(extended_pair(e.kernel_cut), sigma));
#endif
  extended->sigma = pair_of(sigma_y);
  extended->radius = radius_of(sigma_y, extent, e) * farther;
  const float x = high_part(extended_difference(place.x, extended_of(e.middle_x)));
  const float y = high_part(extended_difference(place.y, extended_of(e.middle_y)));
  splat->sigma = high_part(sigma_y);
  const float far = fabs(x) + fabs(y);
  splat->radius = rounded_radius(extended->radius, far);
#if ELLIPSES
  extended->along_x.sigma = pair_of(sigma_x);
  extended->along_x.radius = radius_of(sigma_x, extent, e) * farther;
  splat->along_x.sigma = high_part(sigma_x);
  // Copies lie up to four periods farther, or three and as far over a pole.
  splat->along_x.radius = rounded_radius(extended->along_x.radius, far + 4.0f * p.period);
#endif
  const float beside =
      max(RADIUS_X(*splat) + max(-p.left, p.right_end), splat->radius + max(-p.top, p.bottom));
  put_in_units(x, y, COPIES ? beside : 0.0f, p, splat);
}

// False if the particle is not in the picture.
static inline int extended_splat(uint i, const ProjectParameters p, const ExtendedParameters e,
                                 const Columns columns,
                                 __global const ComponentColors* component_colors,
                                 __global const float* knots, Splat* splat,
                                 ExtendedSplat* extended) {
  const ExtendedPlace place = extended_place(columns.positions + (size_t)i * 3, p, e);
  if (!place.seen) return 0;
  const Extended raw_h =
      extended_of(columns.smoothing_lengths[(size_t)i * p.smoothing_length_stride]);
  const Extended h = extended_product(raw_h, extended_pair(e.size_factor));
  Extended sigma, weight;
  extended_width(columns.weights[(size_t)i * p.weight_stride], h, place.scale, p, e, &sigma,
                 &weight);

  Extended own[3];
  float brightest = p.peak_color;
  for (int c = 0; c < 3; ++c) {
    const size_t at = p.own_color_stride == 0 ? 0 : (size_t)i * 3 + c;
    own[c] = extended_of(VECTOR_COLORS ? columns.own_colors[at] : 1.0f);
  }
  if (VECTOR_COLORS) {
    const float brightest_own = max(high_part(own[0]), max(high_part(own[1]), high_part(own[2])));
    brightest = max(brightest * brightest_own, p.peak_own);
  }
  const float share = FACE_OF_CUBE ? extended_face_part(ellipse_on_face(place, sigma, p, e))
                                   : min(1.0f, 3.2f * high_part(sigma) * high_part(sigma));
  weight = extended_product(extended_limited_weight(weight, brightest * share),
                            extended_normalized(columns.intensities[(size_t)i * p.intensity_stride],
                                                p.intensity.scaling, e.intensity));
  if (has_fade(p)) weight = extended_after_fade(weight, place.depth, p, e);
  Extended emission[3], absorption[3];
  const Extended position =
      extended_normalized(columns.colors[(size_t)i * p.color_stride], p.color.scaling, e.color);
  extended_amplitudes(position, weight, own, component_colors[p.component], knots, e, emission,
                      absorption);

  float peak = 0.0f;
  for (int c = 0; c < 3; ++c) {
    peak = max(peak, max(high_part(emission[c]), high_part(absorption[c])));
    extended->summed[c] = pair_of(e.sums_emission ? emission[c] : absorption[c]);
    extended->emission[c] = pair_of(emission[c]);
  }
  if (FACE_OF_CUBE) peak *= share;
  splat->weight = high_part(weight);
  splat->color = high_part(position);
  extended_shape(place, sigma, peak, p, e, splat, extended);
  const float x = pixels_from_middle(splat->x, *splat, p);
  const float y = pixels_from_middle(splat->y, *splat, p);
  const int in_rows = y + splat->radius >= p.top && y - splat->radius <= p.bottom;
  const int in_columns = x + RADIUS_X(*splat) >= p.left && x - RADIUS_X(*splat) <= p.right_end;
  // Copies of what is beside the picture may reach it.
  return in_rows && (COPIES || in_columns);
}

static inline ExtendedSplat copy_of(const Copy copy, ExtendedSplat splat,
                                    const ExtendedParameters e) {
  if (!COPIES) return splat;
  const Extended moved =
      extended_product(extended_of(0.5f * (float)copy.half_periods), extended_pair(e.period));
  splat.x = pair_of(extended_sum(extended_pair(splat.x), moved));
  if ((copy.half_periods & 1) != 0) {
    const Extended mirrored = extended_difference(extended_pair(OF_POLE(e.twice_pole, copy.pole)),
                                                  extended_pair(splat.y));
    splat.y = pair_of(mirrored);
  }
  return splat;
}
