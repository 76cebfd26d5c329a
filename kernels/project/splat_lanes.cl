// Particles to splats, LANES at a time, step by step.
#include "kernels/common/common.cl"
#include "kernels/common/lanes.cl"
#include "kernels/project/limits.cl"
#include "kernels/project/load.cl"
#include "kernels/project/project.h"
#include "kernels/project/sharp_places.cl"
#include "kernels/project/splat_brightness.cl"
#include "kernels/project/splat_reach.cl"
#include "kernels/project/splat_sampling.cl"
#include "kernels/project/splat_widths.cl"
#include "kernels/project/view.cl"

#pragma OPENCL FP_CONTRACT OFF

INLINED int has_fade(const ProjectParameters p) {
  return p.inverse_near_fade > 0.0f || p.inverse_far_fade > 0.0f;
}

// Smoothly from 0 to 1.
INLINED VALUE rising(VALUE part) {
  const VALUE u = clamp(part, (VALUE)(0.0f), (VALUE)(1.0f));
  return u * u * (3.0f - 2.0f * u);
}
// The part of their light that particles at these depths keep.
INLINED VALUE part_after_fade(VALUE depth, const ProjectParameters p) {
  VALUE part = (VALUE)(1.0f);
  if (p.inverse_near_fade > 0.0f) part = rising((depth - p.fade_begin) * p.inverse_near_fade);
  if (p.inverse_far_fade > 0.0f) part *= rising((p.fade_end - depth) * p.inverse_far_fade);
  return part;
}

// Particles from i on; those at or beyond `end` are neither visible nor bad.
INLINED SplatLanes project_lanes(uint i, uint end, const ProjectParameters p,
                                 __global const WidthNeeds* needs, const SharpParameters e,
                                 const Columns columns) {
  SplatLanes s;
  const ParticleLanes particles = load_particles(columns, i, end, p);
  const ViewLanes of_center = view_particles(particles, p);
  ViewLanes view = of_center;
  INTEGER good = are_good(particles, view.offset);
  s.sort_field = particles.sort_field;
  s.bad = particles.exists & (good == 0);
  s.too_sharp = (INTEGER)(0);
  if (CLOUDS_AROUND) {
    s.around = particles.exists & good & are_around(particles.h, view.offset, p);
    good &= s.around == 0;
  }
  WidthLanes widths = find_widths(particles.h, view, p);
  view = place_of_splat(view, widths);
  const LimitLanes limits = compare_with_limits(view, widths.h, p);
  s.unclear = limits.unclear;
  s.visible = particles.exists & good & limits.may_be_within & may_be_seen(view, widths, p);
  if (!ANY(s.visible)) return s;

  const VALUE brightest = brightest_color(particles, p), share = share_of_peak(widths);
  VALUE center_weight = find_weight(particles.weight, view, widths, p);
  if (FACE_OF_CUBE) center_weight *= widths.part;
  VALUE weight = limited_weight(center_weight, brightest * share) *
                 normalized(particles.intensity, p.intensity);
  if (has_fade(p)) weight *= part_after_fade(view.depth, p);
  const VALUE amplitude = weight * brightest;
  const BrightnessLanes brightness =
      find_brightness(amplitude * share * counted_part(amplitude, p), widths, needs, p);
  const INTEGER sharp = s.visible & are_sharp(view, narrow_sigma(widths), brightness.crowd_peak, p);
  if (ANY(sharp)) {
    s.too_sharp = sharp & are_too_sharp(view, narrow_sigma(widths), brightness.own_peak,
                                        brightness.crowd_peak, p);
    // Places in wide angles need double precision.
    if (WIDE_ANGLE) s.too_sharp |= sharp & (INTEGER)(DOUBLE_NUMBERS ? 0 : -1);
    view = of_center;
    if (WIDE_ANGLE)
      find_sharp_places(i, end, sharp, columns, e, &view);
    else
      view = sharp_view_in_plane(view, sharp, particles.position, p, e);
    widths = find_widths(particles.h, view, p);
    view = place_of_splat(view, widths);
  }
  const SampledLanes sampled = choose_sampling(widths, brightness, weight, p);
  const VALUE extent = p.kernel_cut > 0.0f
                           ? (VALUE)(p.kernel_cut)
                           : truncation_extent(brightness.own_peak, brightness.farther, p);
  place_on_grid(&s, view, widths, sampled, brightness, extent, p);
  if (EXTENDED_NUMBERS) make_room_for_roundings(&s, p);
  keep_those_that_reach(&s, p);
  s.weight = restored_weight(s.weight, drawn_sigma(widths), extent, sampled.by_mean,
                             are_placed_as_stencils(s), p);
  s.color = normalized(particles.color, p.color);
  s.sigma = choose(s.sigma, -s.sigma, brightness.bright & sampled.by_mean);
  if (ELLIPSES) s.sigma_x = choose(s.sigma_x, -s.sigma_x, brightness.bright & sampled.by_mean_x);
  if (VECTOR_COLORS) s.own_color = particles.own_color;
  return s;
}
