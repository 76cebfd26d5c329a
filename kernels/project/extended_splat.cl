// Splats of extended precision, from what the projection found in double precision.
#include "kernels/common/common.cl"
#include "kernels/common/lanes.cl"
#include "kernels/common/splat.h"
#include "kernels/project/amplitudes.cl"
#include "kernels/project/project.h"
#include "kernels/project/splat_widths.cl"
#include "kernels/project/wide_angle.cl"

#pragma OPENCL FP_CONTRACT OFF

// Of one lane.
INLINED REAL real_of(VALUE values, uint k) {
  return ((const REAL*)&values)[k];
}

INLINED FloatPair pair_of(REAL number) {
  FloatPair pair;
  pair.high = (float)number;
  pair.low = isfinite(pair.high) ? (float)(number - (REAL)pair.high) : 0.0f;
  return pair;
}
INLINED REAL number_of(FloatPair pair) {
  return (REAL)pair.high + (REAL)pair.low;
}

INLINED Amplitudes amplitudes_of_lane(const SplatLanes* s, uint k, const ComponentColors colors,
                                      __global const float* knots, const ProjectParameters p) {
  Paint paint;
  paint.position = real_of(s->color, k);
  // On a face of a cube weights are those of splats.
  paint.weight = real_of(s->weight, k) / (FACE_OF_CUBE ? real_of(s->part, k) : 1.0f);
  paint.brightness = p.brightness;
  paint.absorption_factor = p.absorption_factor;
  paint.own_color = (REAL3)(1.0f);
  if (VECTOR_COLORS) {
    paint.own_color =
        (REAL3)(real_of(s->own_color.x, k), real_of(s->own_color.y, k), real_of(s->own_color.z, k));
  }
  Amplitudes found = amplitudes_of(paint, colors, knots);
  if (colors.absorption_kind == ABSORPTION_GRAY)
    absorb_gray(&found, found.emission, p.absorption_factor);
  return found;
}

INLINED ExtendedSplat extended_splat(const SplatLanes* s, uint k,
                                     __global const ComponentColors* component_colors,
                                     __global const float* knots, const ProjectParameters p) {
  const Amplitudes amplitudes = amplitudes_of_lane(s, k, component_colors[p.component], knots, p);
  const REAL3 summed = LIGHT_EMISSION ? amplitudes.emission : amplitudes.absorption;
  ExtendedSplat splat;
  splat.x = pair_of(real_of(s->x, k));
  splat.y = pair_of(real_of(s->y, k));
  splat.sigma = pair_of(real_of(s->sigma, k));
  splat.cut = pair_of(p.kernel_cut * (FACE_OF_CUBE ? 1.0f : real_of(s->sigma, k)));
  splat.summed[0] = pair_of(summed.x);
  splat.summed[1] = pair_of(summed.y);
  splat.summed[2] = pair_of(summed.z);
  splat.emission[0] = pair_of(amplitudes.emission.x);
  splat.emission[1] = pair_of(amplitudes.emission.y);
  splat.emission[2] = pair_of(amplitudes.emission.z);
#if ELLIPSES
  splat.sigma_x = pair_of(real_of(s->sigma_x, k));
#endif
#if FACE_OF_CUBE
  splat.tilt.squared_width = pair_of(real_of(s->face.squared_width, k));
  splat.tilt.footprint = pair_of(real_of(s->face.footprint, k));
  splat.tilt.inverse_secant2 = pair_of(1.0f / real_of(s->face.secant2, k));
#endif
  return splat;
}

INLINED ExtendedSplat copy_of(const Copy copy, ExtendedSplat splat, const ProjectParameters p) {
  splat.x = pair_of(number_of(splat.x) + 0.5f * (float)copy.half_periods * p.period);
  if ((copy.half_periods & 1) != 0)
    splat.y = pair_of(OF_POLE(p.twice_pole, copy.pole) - number_of(splat.y));
  return splat;
}
