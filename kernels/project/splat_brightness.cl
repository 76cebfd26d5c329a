// How bright LANES splats are: what decides how exactly they are drawn.
#include "kernels/common/common.cl"
#include "kernels/common/grid.h"
#include "kernels/common/lanes.cl"
#include "kernels/project/limits.cl"
#include "kernels/project/load.cl"
#include "kernels/project/project.h"
#include "kernels/project/splat_widths.cl"

#pragma OPENCL FP_CONTRACT OFF

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

static inline INTEGER octave_of(VALUE width2) {
  return clamp((power_of_two(width2) >> 1) + 1, (INTEGER)(0), (INTEGER)(WIDTH_OCTAVES - 1));
}

// The larger one of two octaves between which a width lies, as far as single precision knows: the
// check, which has widths as they are drawn, may take it for one of either.
static inline VALUE need_of_width(__global const float* values, VALUE width2,
                                  const ProjectParameters p) {
  const float rounding = 1e-6f;
  return max(value_of_octave(values, p.octaves_in_need, octave_of(width2 * (1.0f - rounding))),
             value_of_octave(values, p.octaves_in_need, octave_of(width2 * (1.0f + rounding))));
}

// The largest of E and A at weight 1.
INLINED VALUE brightest_color(const ParticleLanes particles, const ProjectParameters p) {
  VALUE brightest = p.peak_color;
  if (VECTOR_COLORS) {
    const Vectors own = particles.own_color;
    brightest = max(brightest * max(own.x, max(own.y, own.z)), (VALUE)(p.peak_own));
  }
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
  const VALUE area = drawn_sigma(widths) * drawn_sigma_x(widths);
  return min((VALUE)(1.0f), 3.2f * area);
}

// `own_peak` is the splat's, without those that it lies upon.
INLINED BrightnessLanes find_brightness(VALUE own_peak, const WidthLanes widths,
                                        __global const WidthNeeds* needs,
                                        const ProjectParameters p) {
  const VALUE sigma = drawn_sigma(widths);
  BrightnessLanes b;
  b.own_peak = own_peak;
  b.crowd_peak = b.own_peak;
  b.farther = (VALUE)(0.0f);
  b.bright = b.own_peak > p.bright_peak;
  if (p.octaves_in_need == 0) return b;
  const VALUE width2 = sigma * max(sigma, drawn_sigma_x(widths)) + p.widening;
  b.farther = need_of_width(needs->farther, width2, p);
  if (p.has_bright_octaves) {
    const VALUE light = need_of_width(needs->light, width2, p);
    b.crowd_peak = max(b.own_peak, light);
    // All of the octave, the ones that are brighter still as well: the check takes it for granted.
    b.bright |= light > 0.0f;
  }
  return b;
}
