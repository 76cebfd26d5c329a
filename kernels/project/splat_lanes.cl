// Particles to splats, LANES at a time, step by step.
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

// How bright a splat is: what decides how exactly it is drawn.
typedef struct BrightnessLanes {
  VALUE own_peak;    // the largest of E and A in a pixel
  VALUE crowd_peak;  // or that of all the splats that it lies upon
  VALUE farther;     // added to the square of its extent
  INTEGER bright;
} BrightnessLanes;

// Few octaves need anything.
static inline VALUE value_of_octave(__global const float* values, int count, INTEGER octave) {
  VALUE found = (VALUE)(0.0f);
  for (int k = 0; k < count; ++k)
    found = choose(found, (VALUE)(values[k]), octave == k);
  return found;
}

// The largest of E and A at weight 1.
INLINED VALUE brightest_color(const ParticleLanes particles, const ProjectParameters p) {
  VALUE brightest = p.peak_color;
#ifdef VECTOR_COLORS
  const Vectors own = particles.own_color;
  brightest = max(brightest * max(own.x, max(own.y, own.z)), (VALUE)(p.peak_own));
#endif
  return brightest;
}

// Of an amplitude at its peak: emission counts as it is, absorption times the light behind.
INLINED VALUE counted_part(VALUE amplitude, const ProjectParameters p) {
  VALUE part = (VALUE)(p.counted_part);
  if (p.gray_absorption > 0.0f) part = max(part, amplitude / (amplitude + p.gray_absorption));
  return part;
}

// The flux, not the peak, limits what a splat below a pixel can do to a pixel.
INLINED VALUE share_of_peak(const WidthLanes widths) {
#ifdef ELLIPSES
  const VALUE area = DRAWN_SIGMA(widths) * DRAWN_SIGMA_X(widths);
#else
  const VALUE area = widths.sigma * widths.sigma;
#endif
  return min((VALUE)(1.0f), 3.2f * area);
}

// `own_peak` is the splat's, without those that it lies upon.
INLINED BrightnessLanes find_brightness(VALUE own_peak, const WidthLanes widths,
                                        __global const WidthNeeds* needs,
                                        const ProjectParameters p) {
  const VALUE sigma = DRAWN_SIGMA(widths);
  BrightnessLanes b;
  b.own_peak = own_peak;
  b.crowd_peak = b.own_peak;
  b.farther = (VALUE)(0.0f);
  b.bright = b.own_peak > p.bright_peak;
  if (p.octaves_in_need == 0) return b;
#ifdef ELLIPSES
  const VALUE width2 = sigma * max(sigma, DRAWN_SIGMA_X(widths)) + p.widening;
#else
  const VALUE width2 = sigma * sigma + p.widening;
#endif
  const INTEGER octave =
      clamp((power_of_two(width2) >> 1) + 1, (INTEGER)(0), (INTEGER)(WIDTH_OCTAVES - 1));
  b.farther = value_of_octave(needs->farther, p.octaves_in_need, octave);
  if (p.has_bright_octaves) {
    const VALUE light = value_of_octave(needs->light, p.octaves_in_need, octave);
    b.crowd_peak = max(b.own_peak, light);
    // All of the octave, the ones that are brighter still as well: the check takes it for granted.
    b.bright |= light > 0.0f;
  }
  return b;
}

// Sampling: narrow splats take means over pixels, others the center values of a widened
// Gaussian of the same light.
typedef struct SampledLanes {
  INTEGER by_mean;
  VALUE sigma, weight;
#ifdef ELLIPSES
  INTEGER by_mean_x;
  VALUE sigma_x;
#endif
} SampledLanes;

INLINED SampledLanes choose_sampling(const WidthLanes widths, const BrightnessLanes brightness,
                                     VALUE weight, const ProjectParameters p) {
  SampledLanes s;
  const VALUE sigma = DRAWN_SIGMA(widths);
  VALUE mean_limit = (VALUE)(p.mean_sigma);
  if (ANY(brightness.bright)) {
    mean_limit = choose(mean_limit, bright_mean_limit(brightness.crowd_peak, p), brightness.bright);
  }
  s.by_mean = sigma < mean_limit;
  s.sigma = sigma;
  s.weight = weight;
#ifdef ELLIPSES
  const VALUE sigma_x = DRAWN_SIGMA_X(widths);
  s.by_mean_x = sigma_x < mean_limit;
  s.sigma_x = sigma_x;
#endif
  if (p.widening == 0.0f) return s;
  const VALUE widened2 = sigma * sigma + p.widening;
  s.sigma = choose(sqrt(widened2), sigma, s.by_mean);
#ifdef ELLIPSES
  s.sigma_x = choose(sqrt(sigma_x * sigma_x + p.widening), sigma_x, s.by_mean_x);
  s.weight = weight * ((sigma / s.sigma) * (sigma_x / s.sigma_x));
#else
  // The square of the quotient of both widths, which does not wait for the root.
  s.weight = choose(weight * (1.0f - p.widening / widened2), weight, s.by_mean);
#endif
  return s;
}

// Puts the splat on its grid: its width, weight and radius there. `extent` is in sigma.
INLINED void place_on_grid(SplatLanes* s, const ViewLanes view, const WidthLanes widths,
                           const SampledLanes sampled, const BrightnessLanes brightness,
                           VALUE extent, const ProjectParameters p) {
  s->grid = (INTEGER)(0);
  if (p.grid_count > 1) {
    // Coarse grids know center values only, and splats of a crowd may be taken as means that are
    // wide enough for one.
    s->grid =
        select(choose_grid(sampled.sigma, brightness.own_peak, p), (INTEGER)(0), sampled.by_mean);
  }
  const INTEGER level = level_of(s->grid, p);
  const VALUE shrink = AS_VALUE((127 - level) << 23);
  s->sigma = sampled.sigma * shrink;
  s->farthest_shown =
      choose(p.sigmas_shown * s->sigma, (VALUE)(FLT_MAX), brightness.own_peak > 1.0f);
  s->weight = sampled.weight;
  const INTEGER stencil = are_stencils(s->grid, s->sigma, brightness.own_peak, p);
  const INTEGER narrowed = (s->grid > 0) & (stencil == 0);
  if (p.blurs.sigma2[0] > 0.0f && ANY(narrowed)) {
    // The grid's blur widens what is drawn to the splat's width, and spreads its light.
    const VALUE drawn = sqrt(s->sigma * s->sigma - blur_of(s->grid, p));
    const VALUE spread = s->sigma / drawn;
    s->weight *= choose((VALUE)(1.0f), spread * spread, narrowed);
    s->sigma = choose(s->sigma, drawn, narrowed);
  }
  // A pixel mean sees a splat that reaches the pixel's edge. A cut disc has the radius of
  // the model's sigma, not of the widened one, and means always keep the pixel at its center.
  const VALUE edge = choose((VALUE)(0.0f), (VALUE)(0.5f), sampled.by_mean);
  const float cut_edge = p.widening > 0.0f ? 0.5f : 0.0f;
  s->radius = p.kernel_cut > 0.0f ? p.kernel_cut * DRAWN_SIGMA(widths) * shrink + cut_edge
                                  : extent * s->sigma + edge;
  s->radius = choose(s->radius, (VALUE)(STENCIL_RADIUS), stencil);
  s->sigma = choose(s->sigma, -s->sigma, stencil);
#ifdef ELLIPSES
  // Such pictures have no coarse grids.
  const VALUE edge_x = choose((VALUE)(0.0f), (VALUE)(0.5f), sampled.by_mean_x);
  s->sigma_x = sampled.sigma_x;
  s->radius_x = p.kernel_cut > 0.0f ? p.kernel_cut * DRAWN_SIGMA_X(widths) + cut_edge
                                    : extent * sampled.sigma_x + edge_x;
#endif
#ifdef FACE_OF_CUBE
  s->face = widths.face;
  s->part = widths.part;
  s->farther = face_reach(widths.face, extent, p);
  s->radius *= s->farther;
  s->radius_x *= s->farther;
#endif
  s->x = view.x * shrink;
  s->y = view.y * shrink;
  VALUE farthest = max(fabs(s->x), fabs(s->y));
#ifdef COPIES
  farthest = max(farthest, s->radius_x + max(-p.left, p.right_end));
  farthest = max(farthest, s->radius + max(-p.top, p.bottom) + 2.0f);
#endif
  s->place = splat_place(s->x, view.x_low * shrink, s->y, view.y_low * shrink, farthest, p);
  s->component_and_grid = (INTEGER)((int)p.component) | (s->grid << 16) | (s->place.coarser << 24);
}

// How far the center lies beyond a rectangle of the picture, along the axis where it is farthest,
// in pixels of its grid; below 0: within. Along x a wide splat counts as if it were as wide as it
// is high.
INLINED VALUE distance_beyond(const SplatLanes s, float left, float right_end, float top,
                              float bottom, const ProjectParameters p) {
  const INTEGER level = level_of(s.grid, p);
  const VALUE shrink = AS_VALUE((127 - level) << 23);
  VALUE beyond = max(top * shrink - s.y, s.y - bottom * shrink);
#ifndef COPIES
  VALUE beyond_x = max(left * shrink - s.x, s.x - right_end * shrink);
#ifdef ELLIPSES
  // With the half pixel that the first center lies within: it reaches just where one as wide as it
  // is high does.
  beyond_x = min(beyond_x, (beyond_x + 0.5f) * (s.radius / s.radius_x) - 0.5f);
#endif
  beyond = max(beyond, beyond_x);
#endif
  return beyond;
}

// Whether something of it shows in the whole picture, of splats on grids beside the picture's own.
INLINED INTEGER shows_in_picture(const SplatLanes s, const ProjectParameters p) {
  const float left = (float)-p.middle_x, top = (float)-p.middle_y;
  const VALUE beyond =
      distance_beyond(s, left, left + (float)p.width, top, top + (float)p.height, p);
  return (s.grid == 0) | (beyond <= s.farthest_shown);
}

// By the sign that place_on_grid() gives them.
INLINED INTEGER are_placed_as_stencils(const SplatLanes s) {
  return (s.grid > 0) & (s.sigma < 0.0f);
}

// Leaves out splats whose squares do not reach what is in memory of their grid, or nearly. Those
// that end short of it by no more than their own radius leave something out, though: they are
// listed, with a minus before a radius that reaches, so that the check after drawing knows them,
// and not drawn. Guard bands, from which pixels of the picture are interpolated or blurred, need
// nothing of what shows nowhere in it.
INLINED void keep_those_that_reach(SplatLanes* s, const ProjectParameters p) {
  const VALUE beyond = distance_beyond(*s, p.left, p.right_end, p.top, p.bottom, p);
  const VALUE room = choose((VALUE)(0.0f), (VALUE)(p.beside), s->grid > 0);
  // The first pixel's center lies half a pixel within.
  const INTEGER reaches = (beyond + 0.5f <= s->radius + room) & shows_in_picture(*s, p);
#ifdef COPIES
  s->visible &= reaches;
#else
  // Stencils leave nothing out.
  const INTEGER ends_short = (reaches == 0) & (beyond <= 2.0f * s->radius) &
                             (are_placed_as_stencils(*s) == 0) &
                             (INTEGER)(p.kernel_cut > 0.0f ? 0 : -1);
  s->visible &= reaches | ends_short;
#ifdef FACE_OF_CUBE
  const VALUE in_widths = beyond / max(s->farther, (VALUE)(1.0f));
#else
  const VALUE in_widths = beyond;
#endif
  s->radius = choose(s->radius, -(in_widths + 1.0f), ends_short);
#endif
}

// Half of the light beyond the square goes back into it: the sum of many errs by as much
// above as below. Means are drawn in all pixels that the square touches, half a pixel more
// on average and for a splat below a pixel nearly everything: with t / sigma more, erfc(k)
// falls as exp(-2 k t / sigma), whose mean over t from 0 to 1 is close to
// sigma / (sigma + 2 k).
INLINED VALUE restored_weight(VALUE weight, VALUE sigma, VALUE extent, INTEGER by_mean,
                              INTEGER stencil, const ProjectParameters p) {
  const INTEGER faint = (extent <= p.least_extent * 1.00001f) & (stencil == 0);
  const VALUE cut_off = choose((VALUE)(1.0f), sigma / (sigma + 2.0f * extent), by_mean);
  return choose(weight, weight * (1.0f + p.restored_light * cut_off), faint);
}

#ifdef EXTENDED_NUMBERS
// Only what certainly lies off the picture is left out; extended_splat() decides. Ten sigma
// reach beyond the truncation of any amplitude that single precision holds.
#ifdef WIDE_ANGLE
// Directions in single precision are known to 1e-6, beside an eye that is nearly as far away as
// the particle to 5e-4; near a pole, or behind a fisheye, that is as wide as it magnifies.
INLINED INTEGER may_be_seen_extended(const ViewLanes view, const WidthLanes widths,
                                     const ProjectParameters p) {
  const float focal = p.pixels_per_length;
#ifdef FACE_OF_CUBE
  const VALUE sigma =
      max(widths.face.sigma_x, widths.face.sigma_y) * face_reach(widths.face, (VALUE)(10.0f), p);
#else
  const VALUE sigma = widths.sigma;
#endif
  const VALUE reach =
      10.0f * fabs(sigma) + 4.0f + 5e-3f * focal + 1e-4f * (fabs(view.x) + fabs(view.y));
  INTEGER off = view.y + reach<p.top | view.y - reach> p.bottom;
#ifdef COPIES
  const VALUE reach_x = 10.0f * fabs(widths.sigma_x) + 4.0f +
                        1e-3f * focal / max(view.cos_latitude - 1e-3f, (VALUE)(0.0f));
  off |= ceil((p.left - reach_x - view.x) / p.period) >
         floor((p.right_end + reach_x - view.x) / p.period);
#else
  off |= view.x + reach<p.left | view.x - reach> p.right_end;
#endif
#ifdef PROJECTION_FISHEYE
  const VALUE x = view.x - p.center_x, y = view.y - p.center_y;
  off &= x * x + y * y < 9.6f * focal * focal;
#endif
  return off == 0;
}
#else
INLINED INTEGER may_be_seen_extended(const ViewLanes view, const WidthLanes widths,
                                     const ProjectParameters p) {
  const Vectors d = view.offset;
  const VALUE rounding = 1e-6f * (fabs(d.x) + fabs(d.y) + fabs(d.z)) * fabs(view.scale);
  const VALUE reach =
      10.0f * fabs(widths.sigma) + 4.0f + rounding + 1e-4f * (fabs(view.x) + fabs(view.y));
  const INTEGER off = view.x + reach<p.left | view.x - reach> p.right_end |
                      view.y + reach<p.top | view.y - reach> p.bottom;
  return off == 0;
}
#endif
#endif

// Particles from i on; those at or beyond `end` are neither visible nor bad.
INLINED SplatLanes project_lanes(uint i, uint end, const ProjectParameters p,
                                 __global const WidthNeeds* needs, const ExtendedParameters e,
                                 const Columns columns) {
  SplatLanes s;
  const ParticleLanes particles = load_particles(columns, i, end, p);
  const ViewLanes of_center = view_particles(particles, p);
  ViewLanes view = of_center;
  INTEGER good = are_good(particles, view.offset);
  s.sort_field = particles.sort_field;
  s.bad = particles.exists & (good == 0);
  s.too_sharp = (INTEGER)(0);
#ifdef CLOUDS_AROUND
  s.around = particles.exists & good & are_around(particles.h, view.offset, p);
  good &= s.around == 0;
#endif
  WidthLanes widths = find_widths(particles.h, view, p);
  view = place_of_splat(view, widths);
#ifdef EXTENDED_NUMBERS
  s.visible = particles.exists & good & may_be_seen_extended(view, widths, p);
  s.unclear = s.visible;
  return s;
#else
  const LimitLanes limits = compare_with_limits(view, widths.h, p);
  s.unclear = limits.unclear;
  s.visible = particles.exists & good & limits.may_be_within & may_be_seen(view, widths, p);
  if (!ANY(s.visible)) return s;

  const VALUE brightest = brightest_color(particles, p), share = share_of_peak(widths);
  VALUE center_weight = find_weight(particles.weight, view, widths, p);
#ifdef FACE_OF_CUBE
  center_weight *= widths.part;
#endif
  const VALUE weight = limited_weight(center_weight, brightest * share) *
                       normalized(particles.intensity, p.intensity);
  const VALUE amplitude = weight * brightest;
  const BrightnessLanes brightness =
      find_brightness(amplitude * share * counted_part(amplitude, p), widths, needs, p);
  const INTEGER sharp = s.visible & are_sharp(view, NARROW_SIGMA(widths), brightness.crowd_peak, p);
  if (ANY(sharp)) {
    s.too_sharp = sharp & are_too_sharp(view, NARROW_SIGMA(widths), brightness.own_peak,
                                        brightness.crowd_peak, p);
#ifdef WIDE_ANGLE
    view = sharp_view(of_center, sharp, i, end, columns, p, e);
#else
    view = sharp_view(of_center, sharp, particles.position, p, e);
#endif
    widths = find_widths(particles.h, view, p);
    view = place_of_splat(view, widths);
  }
  const SampledLanes sampled = choose_sampling(widths, brightness, weight, p);
  const VALUE extent = p.kernel_cut > 0.0f
                           ? (VALUE)(p.kernel_cut)
                           : truncation_extent(brightness.own_peak, brightness.farther, p);
  place_on_grid(&s, view, widths, sampled, brightness, extent, p);
  keep_those_that_reach(&s, p);
  s.weight = restored_weight(s.weight, DRAWN_SIGMA(widths), extent, sampled.by_mean,
                             are_placed_as_stencils(s), p);
  s.color = normalized(particles.color, p.color);
  s.sigma = choose(s.sigma, -s.sigma, brightness.bright & sampled.by_mean);
#ifdef ELLIPSES
  s.sigma_x = choose(s.sigma_x, -s.sigma_x, brightness.bright & sampled.by_mean_x);
#endif
#ifdef VECTOR_COLORS
  s.own_color = particles.own_color;
#endif
  return s;
#endif
}
