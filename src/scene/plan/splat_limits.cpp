#include "scene/plan/splat_limits.h"

#include <algorithm>
#include <cmath>

namespace splotchcl {
namespace {

// So many clouds of peak 0.1 overlapped in tests.
constexpr double ends_in_a_pixel = 24;

float stop_limit(double brightest, double share) {
  constexpr float never = -1;
  if (!std::isfinite(brightest) || share <= 0) return never;
  return brightest > 0 ? static_cast<float>(std::min(1.0, share / brightest)) : 1.0f;
}

// The widened center value errs by 7.7e-3 / sigma^4 of the peak.
float widest_of_means(double response, const ToleranceShares& shares) {
  const double sigma = std::pow(7.7e-3 * response / shares.pixel_mean, 0.25);
  // At least so much that octaves of widths up to 2 are of means alone, which the check after
  // drawing tells apart (certificate/octave_errors.cpp).
  constexpr double least = 1.96;
  return static_cast<float>(std::clamp(sigma, least, 64.0));
}

}  // namespace

double center_value_error(double sigma_pixels) {
  const double sigma2 = sigma_pixels * sigma_pixels;
  return 8.2e-3 / (sigma2 * sigma2);
}

bool takes_pixel_means(const Frame& frame) {
  return frame.kernel.sampling == Sampling::mean && frame.projection != Projection::cube;
}

SplatLimits choose_splat_limits(const Frame& frame, const ToleranceShares& shares, LightPlan light,
                                const Responses& response) {
  SplatLimits limits;
  // Coarse grids have few pixels, so that drawing splats farther in sums costs little, and saves
  // drawing frames again.
  const double margin = light == LightPlan::ordered ? 1 : 5.5;
  const double left_out = shares.truncation / (margin * lattice_rows * response.of_ends);
  const double extent2 = -std::log(std::min(left_out, 1.0));
  limits.least_extent = static_cast<float>(std::sqrt(extent2));
  // A cut is part of the model: nothing is left out. Otherwise half of 1 - erf(k)^2.
  limits.restored_light =
      frame.kernel.cut ? 0.0f : static_cast<float>(std::erfc(std::sqrt(extent2)));
  limits.inverse_edge = static_cast<float>(ends_in_a_pixel / shares.truncation);
  limits.bright_peak = 8;
  if (takes_pixel_means(frame)) {
    limits.mean_sigma = widest_of_means(response.of_means, shares);
    limits.bright_mean_sigma = widest_of_means(response.of_bright_means, shares);
    limits.widening = 1.0f / 6.0f;
  }
  return limits;
}

LayerLimits choose_layer_limits(const ToleranceShares& shares, LightPlan light,
                                double brightest_behind, double response) {
  LayerLimits limits;
  // Two terms of the series err by y^2 / 6 of phi, three by y^3 / 24, four by y^4 / 120.
  const double phi = shares.phi / std::max(1.0, response);
  limits.phi_short = static_cast<float>(std::min(0.5, std::sqrt(6 * phi)));
  limits.phi_third = static_cast<float>(std::min(0.5, std::cbrt(24 * phi)));
  limits.phi_series = static_cast<float>(std::min(0.5, std::pow(120 * phi, 0.25)));
  limits.stop = stop_limit(brightest_behind, shares.early_stop);
  // An opacity close to 1 errs by ten roundings of 1 (exp, phi's difference and quotient, three
  // products, the sum), and with it what shines through.
  limits.keeps_transmittance =
      light == LightPlan::ordered && 10 * 0x1p-24 * brightest_behind > shares.early_stop;
  return limits;
}

}  // namespace splotchcl
