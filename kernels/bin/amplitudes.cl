// The colors of splats: what they emit and absorb at the center.
#include "kernels/bin/bin.h"
#include "kernels/common/common.cl"
#include "kernels/common/grid.cl"
#include "kernels/common/splat.cl"
#include "kernels/common/splat.h"
#include "kernels/project/amplitudes.cl"

INLINED float3 own_color_of(const Splat splat) {
#if VECTOR_COLORS
  return (float3)(splat.own_color.rgb[0], splat.own_color.rgb[1], splat.own_color.rgb[2]);
#else
  return (float3)(1.0f);
#endif
}

#if !LIGHT_ORDERED
// E w, or A w in the proportional plan, at the cloud's centre.
INLINED float3 summed_amplitude(const Splat splat, const ComponentColors colors,
                                __global const float* knots) {
  float3 summed =
      splat.weight * colors.summed_scale *
      sample_knots(knots, colors.first_summed_knot, colors.last_summed_knot, splat.color);
  // An absorption palette of its own is not the particles' colour.
  const int is_own = VECTOR_COLORS && colors.first_summed_knot == colors.first_knot;
  return is_own ? summed * own_color_of(splat) : summed;
}
#else
// A cloud's own amplitude over that of its splat, which is widened where center values are taken,
// and narrower on a coarse grid that is blurred afterwards.
INLINED float own_part(const Splat splat, const BinParameters p) {
#if FACE_OF_CUBE
  return 1.0f / splat.part;
#elif ELLIPSES
  const float drawn2 = splat.sigma * splat.sigma;
  const float across2 = splat.along_x.sigma * splat.along_x.sigma;
  float restored = splat.sigma < p.mean_sigma ? 1.0f : drawn2 / (drawn2 - p.widening);
  restored *= splat.along_x.sigma < p.mean_sigma ? 1.0f : across2 / (across2 - p.widening);
  return sqrt(restored);
#else
  const float drawn2 = splat.sigma * splat.sigma;
  const uint grid = grid_of(splat);
  if (grid == 0) return splat.sigma < p.mean_sigma ? 1.0f : drawn2 / (drawn2 - p.widening);
  const float wide2 = drawn2 + blur_of_grid(grid, &p.blurs);
  const float in_picture2 = wide2 * as_float((127 + 2 * level_of_grid(grid, &p.blurs)) << 23);
  return drawn2 / wide2 * (in_picture2 / (in_picture2 - p.widening));
#endif
}

// E w and A w at the cloud's centre.
INLINED Amplitudes amplitudes_of_splat(const Splat splat, const ComponentColors colors,
                                       __global const float* knots, const BinParameters p) {
  const Paint paint = {splat.color, splat.weight, colors.brightness, colors.absorption_factor,
                       own_color_of(splat)};
  Amplitudes found = amplitudes_of(paint, colors, knots);
  if (colors.absorption_kind == ABSORPTION_GRAY)
    absorb_gray(&found, found.emission * own_part(splat, p), colors.absorption_factor);
  return found;
}
#endif
