// What a particle weighs, how far its splat is drawn, whether its pixels take means, and on
// which grid it lies (docs/dev/accuracy.md), on VALUEs (lanes.cl).
#include "kernels/common/common.cl"
#include "kernels/common/grid.h"
#include "kernels/common/lanes.cl"
#include "kernels/project/load.cl"
#include "kernels/project/project.h"

#pragma OPENCL FP_CONTRACT OFF

// ln(1 + part), part >= 0: what the sum is rounded by is taken off again by the quotient, so that
// however small a part keeps all its digits.
INLINED VALUE log_of_one_more(VALUE part) {
  const VALUE sum = 1.0f + part, there = sum - 1.0f;
  return choose(part, log2_positive(sum) * REAL_OF(0.69314718055994531) * (part / there),
                there > 0.0f);
}

// ln of value / m, and 0 below m.
INLINED VALUE log_from_least(VALUE value, const FieldScaling map) {
  const VALUE part = ((value - map.minimum) - map.minimum_low) * map.factor;
  return log_of_one_more(min(max(part, (VALUE)(0.0f)), (VALUE)(1e38f)));
}

// asinh(v) - asinh(m) = asinh(v sqrt(1 + m^2) - m sqrt(1 + v^2)), of two numbers with the same sign
// by the difference of their squares. Hardly any fields are taken so.
SELDOM_CALLED VALUE asinh_from_least(VALUE value, REAL m, REAL m_low, REAL factor) {
  const VALUE v = min(max(value, (VALUE)(-1e18f)), (VALUE)(1e18f));
  const VALUE difference = (v - m) - m_low;
  const VALUE from_v = v * factor, from_m = m * sqrt(1.0f + v * v);
  return asinh(choose(from_v - from_m, difference * ((v + m) / (from_v + from_m)), v * m > 0.0f));
}

// A field in [0, 1] (frame.h, ScalarMap).
INLINED VALUE normalized(VALUE value, const FieldScaling map) {
  if (map.scaling >= SCALING_LOG_FROM_LEAST) {
    const VALUE from_least =
        map.scaling == SCALING_LOG_FROM_LEAST
            ? log_from_least(value, map)
            : asinh_from_least(value, map.minimum, map.minimum_low, map.factor);
    const VALUE place = clamp(from_least * map.inverse_range, (VALUE)(0.0f), (VALUE)(1.0f));
    return choose((VALUE)(0.0f), place, is_finite(value));
  }
  VALUE scaled = value;
  if (map.scaling == SCALING_LOG) {
    scaled = choose((VALUE)(-INFINITY),
                    log2_positive(max(value, (VALUE)(1e-45f))) * REAL_OF(0.30102999566398120),
                    value > 0.0f);
  }
  if (map.scaling == SCALING_ASINH) scaled = asinh(value);
  const VALUE normal = clamp(((scaled - map.minimum) - map.minimum_low) * map.inverse_range,
                             (VALUE)(0.0f), (VALUE)(1.0f));
  return choose((VALUE)(0.0f), normal, is_finite(scaled));
}

// w (scene.h, WeightModel); sigma_scaled is sigma in world units times length_scale.
static inline VALUE column_weight(VALUE raw, VALUE h, const ProjectParameters p) {
  const VALUE sigma_scaled = max(p.kernel_width * h * p.length_scale, (VALUE)(FLT_MIN));
  if (p.weight_model == WEIGHT_MASS) {
    return raw * p.weight_scale / sigma_scaled * p.weight_scale / sigma_scaled;
  }
  if (p.weight_model == WEIGHT_DENSITY) return raw * p.weight_scale * sigma_scaled;
  return raw * p.weight_scale / (h * p.length_scale);
}

// What `widening` times the width does to w at that width, for the light to stay the same: columns
// of masses follow the width by themselves.
static inline VALUE weight_of_widened(VALUE weight, VALUE inverse_widening,
                                      const ProjectParameters p) {
  if (p.weight_model == WEIGHT_MASS) return weight;
  const VALUE lowered = weight * inverse_widening;
  if (p.weight_model == WEIGHT_CONSTANT) return lowered;
  return lowered * inverse_widening * inverse_widening;
}

// A weight whose splat gives no pixel more than MOST_LIGHT; `peak` is what it gives per weight.
static inline VALUE limited_weight(VALUE weight, VALUE peak) {
  const INTEGER fits = weight * peak <= MOST_LIGHT;  // not if it is no number
  if (!ANY(fits == 0)) return weight;
  return fmin(weight, min(MOST_LIGHT / max(peak, (VALUE)(FLT_MIN)), (VALUE)(FLT_MAX)));
}

// How many sigma a splat is drawn: at least so far that the light outside the square does
// not show in a sum of many, and for a bright one so far that its own edge does not show.
static inline VALUE truncation_extent(VALUE peak, VALUE farther, const ProjectParameters p) {
  const VALUE over_edge = peak * p.inverse_edge;
  if (!ANY((over_edge > 1.0f) | (farther > 0.0f))) return (VALUE)(p.least_extent);
  const VALUE excess = log2_positive(max(over_edge, (VALUE)(1.0f)));
  return sqrt(max((VALUE)(p.least_extent * p.least_extent), 0.693147181f * excess) + farther);
}

// The width below which a bright splat is taken as means. At the distance where it has faded
// to 1 the widened center value errs by 5.6e-3 ln(peak)^2 / sigma^4 of what is there.
static inline VALUE bright_mean_limit(VALUE peak, const ProjectParameters p) {
  const VALUE fading = 0.693147181f * log2_positive(max(peak, (VALUE)(1.0f)));
  return p.bright_mean_sigma * sqrt(max(0.853f * fading, (VALUE)(1.0f)));
}

// The largest n with 2^n <= value, for positive values.
static inline INTEGER power_of_two(VALUE value) {
  return (AS_INTEGER(value) >> 23) - 127;
}

static inline INTEGER grid_of_octave(INTEGER octave, VALUE peak, const ProjectParameters p) {
  const INTEGER grid = clamp(octave, (INTEGER)(0), (INTEGER)(p.grid_count - 1));
  return select(grid, (INTEGER)(0), peak > p.coarse_peak);
}

// A blur is chosen by two bits.
REQUIRE(four_blurs, MOST_BLURS == 4);

// level_of_grid() and, of coarse grids, blur_of_grid() of grid.cl, of VALUEs.
static inline INTEGER level_of(INTEGER grid, const ProjectParameters p) {
  const INTEGER of_others = ((grid - 1) >> p.blurs.shift) + p.blurs.first_level;
  return select(of_others, (INTEGER)(0), grid == 0);
}
// `values` has one for each blur.
INLINED VALUE value_of_blur(INTEGER grid, const float* values) {
  const INTEGER of_level = grid - 1, is_odd = (of_level & 1) != 0, is_upper = (of_level & 2) != 0;
  const VALUE lower = choose((VALUE)(values[0]), (VALUE)(values[1]), is_odd);
  const VALUE upper = choose((VALUE)(values[2]), (VALUE)(values[3]), is_odd);
  return choose(lower, upper, is_upper);
}
INLINED VALUE blur_of(INTEGER grid, const ProjectParameters p) {
  return value_of_blur(grid, p.blurs.sigma2);
}

// Whether a splat of this sigma, in pixels of its grid, is a stencil: of peaks above 1 they would
// err by more than the interpolation of as wide ones does.
INLINED INTEGER are_stencils(INTEGER grid, VALUE sigma, VALUE peak, const ProjectParameters p) {
  return (grid > 0) & (peak <= 1.0f) & (sigma <= value_of_blur(grid, p.blurs.stencil_sigma));
}

// Wide splats go to the coarsest grid that still shows their shape, bright ones finer. The grids
// of a level share out an octave of widths, the first ones from coarse_sigma on.
static inline INTEGER choose_grid(VALUE sigma, VALUE peak, const ProjectParameters p) {
  VALUE power = sigma * p.inverse_coarse_sigma;
  if (ANY(peak > 1.0f)) {
    // Beside stencils they are narrower Gaussians: of a grid only those that are wider than its
    // stencils can be (are_stencils()).
    const VALUE least = choose((VALUE)(1.0f), (VALUE)(p.blurs.finer_grid), peak > 1.0f);
    power /= max(sqrt(sqrt(sqrt(max(peak, (VALUE)(1.0f))))), least);
  }
  // Higher powers of wider ones may be no number, and theirs is the coarsest grid.
  power = min(power, (VALUE)(1e9f));
  for (int i = 0; i < p.blurs.shift; ++i)
    power *= power;
  return grid_of_octave(power_of_two(power) + 1 - (p.blurs.first_level << p.blurs.shift), peak, p);
}
