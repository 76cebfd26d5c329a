#include "scene/plan/splat_limits.h"

#include <algorithm>
#include <cmath>

namespace splotchcl {
namespace {

// The light that reaches a pixel from beyond the splats' squares comes from neighbors that
// may be brighter than the pixel itself: measured up to 2.3 times what even light would
// give on the cosmological box of docs/accuracy.md. Half of it is put back, so 1.5 covers it.
constexpr double uneven_light = 1.5;

// So many clouds of peak 0.1 overlapped in tests.
constexpr double ends_in_a_pixel = 24;

// In pixels: wider than the clouds of a crowd's first level, narrower than any on a coarse grid.
constexpr double narrow_sigma = 1.75;

// The half side, in sigma, of the square outside which a splat has this fraction of its
// light: 1 - erf(k)^2 < 2 erfc(k) = loss.
double extent_of_loss(double loss) {
  double low = 0, high = 8;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (2 * std::erfc(middle) > loss ? low : high) = middle;
  }
  return high;
}

// A crowd's clouds end where the light of all of them has become so faint.
void limit_crowd(const Crowd& crowd, double truncation, SplatLimits& limits) {
  limits.crowd_light = static_cast<float>(crowd.light);
  const double fading = std::log(std::max(crowd.light / truncation, 1.0));
  limits.crowd_extent = static_cast<float>(std::sqrt(fading));
  limits.crowd_narrowest = static_cast<float>(crowd.narrowest_sigma);
  limits.crowd_widest = static_cast<float>(crowd.widest_sigma);
  // Below, errors relative to a peak are no more than three times their shares; below twice
  // as much in a crowd, whose clouds do not all err alike unless they are all the same.
  limits.crowd_bright = limits.crowd_light > 2 * limits.bright_peak ? limits.crowd_light : 0;
}

float opaque_limit(double brightest, double share) {
  constexpr float never = 2;
  if (!std::isfinite(brightest) || share <= 0) return never;
  return brightest > 0 ? static_cast<float>(1 - share / brightest) : 0.0f;
}

}  // namespace

bool is_wide_crowd(const Crowd& crowd) {
  return crowd.light > 0 && crowd.widest_sigma > narrow_sigma;
}

SplatLimits choose_splat_limits(const KernelSettings& kernel, const ToleranceShares& shares,
                                const Crowd& crowd, double response) {
  SplatLimits limits;
  const double loss = shares.truncation / (uneven_light * response);
  limits.least_extent = static_cast<float>(extent_of_loss(loss));
  // A cut is part of the model: nothing is left out.
  limits.restored_light = kernel.cut ? 0.0f : static_cast<float>(0.5 * loss);
  limits.inverse_edge = static_cast<float>(ends_in_a_pixel / shares.truncation);
  limits.bright_peak = 8;
  limit_crowd(crowd, shares.truncation, limits);
  if (kernel.sampling == Sampling::mean) {
    // The widened center value errs by 7.7e-3 / sigma^4 of the peak.
    const double sigma = std::pow(7.7e-3 * response / shares.pixel_mean, 0.25);
    limits.mean_sigma = static_cast<float>(std::clamp(sigma, 1.5, 64.0));
    limits.widening = 1.0f / 6.0f;
  }
  return limits;
}

LayerLimits choose_layer_limits(const ToleranceShares& shares, LightPlan light,
                                double brightest_behind) {
  LayerLimits limits;
  // Two terms of the series err by y^2 / 6 of phi, four by y^4 / 120.
  limits.phi_short = static_cast<float>(std::min(0.5, std::sqrt(6 * shares.phi)));
  limits.phi_series = static_cast<float>(std::min(0.5, std::pow(120 * shares.phi, 0.25)));
  limits.opaque = opaque_limit(brightest_behind, shares.early_stop);
  // An opacity close to 1 errs by ten roundings of 1 (exp, phi's difference and quotient, three
  // products, the sum), and with it what shines through.
  limits.keeps_transmittance =
      light == LightPlan::ordered && 10 * 0x1p-24 * brightest_behind > shares.early_stop;
  return limits;
}

}  // namespace splotchcl
