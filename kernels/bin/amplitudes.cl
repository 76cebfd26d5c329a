// The colors of splats: what they emit and absorb at the center.
#include "kernels/bin/bin.h"
#include "kernels/common/common.cl"
#include "kernels/common/grid.cl"
#include "kernels/common/splat.cl"
#include "kernels/common/splat.h"

// A position is in [0, 1], so that the knot below is one of them. Behind the last there is one more
// in memory, of which nothing is taken. Vectors, since what a loop writes to an array goes through
// memory in pieces, which a processor cannot forward to the copy of the whole entry.
INLINED float3 sample_knots(__global const float* knots, uint first, float last, float position) {
  const float place = position * last;
  const int below = (int)place;
  __global const float* at = knots + (size_t)(first + (uint)below) * KNOT_FLOATS;
  const float4 color = vload4(0, at), above = vload4(1, at);
  return (color + (place - (float)below) * (above - color)).xyz;
}

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

// Numbers are converted as signed ones, which most processors do in one step.
INLINED float last_of(uint knots) {
  return (float)(int)(knots - 1u);
}

typedef struct Amplitudes {
  float3 emission, absorption;
} Amplitudes;

// E w and A w at the cloud's centre (scene.h, Absorption).
INLINED Amplitudes amplitudes_of(const Splat splat, const ComponentColors colors,
                                 __global const float* knots, const BinParameters p) {
  float3 emitted = sample_knots(knots, colors.first_knot, last_of(colors.knot_count), splat.color);
  if (VECTOR_COLORS) emitted *= own_color_of(splat);
  float3 absorbed = emitted;
  if (colors.absorption_knot_count > 0) {
    absorbed = sample_knots(knots, colors.first_absorption_knot,
                            last_of(colors.absorption_knot_count), splat.color);
  }
  Amplitudes found;
  found.emission = splat.weight * colors.brightness * emitted;
  found.absorption = splat.weight * colors.brightness * absorbed;
  if (colors.absorption_kind == ABSORPTION_NONE) found.absorption = (float3)(0.0f);
  if (colors.absorption_kind == ABSORPTION_FACTOR) {
    found.absorption = splat.weight * colors.absorption_factor * absorbed;
  }
  if (colors.absorption_kind == ABSORPTION_GRAY) {
    const float3 own = found.emission * own_part(splat, p);
    found.absorption = found.emission;
    const float3 emitted_part = own / (own + colors.absorption_factor);
    found.emission = own > 0.0f ? found.emission * emitted_part : (float3)(0.0f);
  }
  return found;
}
#endif
