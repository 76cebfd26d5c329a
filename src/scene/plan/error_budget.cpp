#include "scene/plan/error_budget.h"

#include <algorithm>
#include <cmath>

#include "scene/plan/splat_limits.h"

namespace splotchcl {
namespace {

// Smaller tolerances need polynomials of full single precision ...
constexpr double fast_tolerance = 3e-4;
// ... and places finer than the integers that hold the picture. Below this one, roundings of
// distances and widths leave nothing to be had by them.
constexpr double least_of_fine_places = 2e-6;
// Wider pictures need finer ones at any tolerance: the integers have steps of 8e-6 pixels there.
constexpr int widest_of_integers = 8192;
// Roundings of sums show below this one.
constexpr double small_blocks_tolerance = 3e-5;

constexpr double euler = 2.718281828459045;

// Looked for in steps of depth; between them it changes by less than a hundredth.
double response_of_one_source(double source, double background) {
  double largest = std::min(1.0, std::max(1.0, source) / euler);
  for (double depth = 0.1; depth < 50; depth += 0.1) {
    const double passing = std::exp(-depth);
    const double light = source * (1 - passing) + background * passing;
    const double error = depth * std::abs(background - source) * passing;
    largest = std::max(largest, error / std::max(1.0, light));
  }
  return largest;
}

// A layer of depth x takes x exp(-x) of what lies behind for an error of a part of it, where light
// of 1 or the light itself is what counts.
double response_of_layers(double brightest_source, double brightest_background) {
  const double brightest = std::max({1.0, brightest_background, brightest_source});
  return brightest < euler ? brightest / euler : std::log(brightest);
}

ToleranceShares extended_shares() {
  ToleranceShares shares;
  shares.promise = extended_tolerance;
  // Farther discs cost little; single precision's last digits cannot be had back.
  shares.truncation = 0.01 * extended_tolerance;
  const double arithmetic = extended_tolerance - shares.truncation;
  shares.pixel_mean = 0.5 * arithmetic;
  shares.phi = arithmetic - shares.pixel_mean;
  return shares;
}

ToleranceShares share_out(double tolerance, LightPlan light, bool coarse_grids) {
  const bool ordered = light == LightPlan::ordered;
  ToleranceShares shares;
  shares.promise = tolerance;
  const bool slabs = ordered && coarse_grids;
  shares.slabs = slabs ? 0.1 * tolerance : 0;
  shares.truncation = 0.5 * tolerance - shares.slabs;
  shares.coarse_grids = coarse_grids ? 0.25 * tolerance : 0;
  const double arithmetic = (ordered && !slabs ? 0.5 : 0.25) * tolerance;
  shares.early_stop = ordered ? 0.1 * arithmetic : 0;
  shares.phi = (ordered ? 0.2 : 0.25) * arithmetic;
  shares.pixel_mean = arithmetic - shares.phi - shares.early_stop;
  if (tolerance < small_blocks_tolerance) {
    // Bright means take nearly all that ends leave (docs/dev/accuracy.md), and series are exact at
    // little cost.
    constexpr double of_phi = 0.2, of_early_stop = 0.4;
    shares.phi *= of_phi;
    shares.early_stop *= of_early_stop;
    shares.truncation += arithmetic - shares.arithmetic();
  }
  return shares;
}

// Cut splats leave no light out, and values at pixel centers are no means: their shares are for the
// layers, but for half of that of the ends, which is left to places and roundings.
void give_to_layers(ToleranceShares& shares) {
  shares.truncation *= 0.5;
  shares.phi += shares.pixel_mean + shares.truncation;
  shares.pixel_mean = 0;
}

}  // namespace

ErrorBudget make_extended_budget() {
  ErrorBudget budget;
  budget.precision = Precision::extended;
  budget.shares = extended_shares();
  return budget;
}

ErrorBudget make_error_budget(const Frame& frame, double drawn_for, LightPlan light,
                              bool coarse_grids) {
  ErrorBudget budget;
  if (frame.tolerance < extended_tolerance) return make_extended_budget();
  budget.precision = drawn_for < fast_tolerance ? Precision::full : Precision::fast;
  const bool is_wide = std::max(frame.width, frame.height) > widest_of_integers;
  budget.has_fine_places =
      (is_wide || budget.precision == Precision::full) && drawn_for >= least_of_fine_places;
  budget.adds_small_blocks = drawn_for < small_blocks_tolerance;
  budget.shares = share_out(drawn_for, light, coarse_grids);
  budget.shares.promise = frame.tolerance;
  if (light == LightPlan::ordered && frame.kernel.cut && !takes_pixel_means(frame))
    give_to_layers(budget.shares);
  return budget;
}

double response_to_splats(LightPlan light, double brightest_source, double brightest_background) {
  if (light == LightPlan::emission) return 1;
  // Light without a brightest source shows where nothing is in front of it.
  if (!std::isfinite(brightest_source)) {
    return std::max(1.0, response_of_layers(1, brightest_background));
  }
  if (light == LightPlan::proportional) {
    return response_of_one_source(brightest_source, brightest_background);
  }
  return response_of_layers(brightest_source, brightest_background);
}

double response_to_unchecked(LightPlan light, double brightest_source,
                             double brightest_background) {
  constexpr double stars_behind = 1e3;
  if (light != LightPlan::ordered || std::isfinite(brightest_source)) {
    return response_to_splats(light, brightest_source, brightest_background);
  }
  return response_of_layers(stars_behind, brightest_background);
}

}  // namespace splotchcl
