// The weights by which grids are refined err by no more than docs/dev/accuracy.md and the budget of
// coarse grids say.
#include "scene/plan/refinement_filter.h"

#include "testing.h"

namespace splotchcl {
namespace {

using Weights = std::array<double, refinement_taps>;

// Pixels before the first of those that a new one is made from.
constexpr int taps_before = static_cast<int>(refinement_taps) / 2 - 1;

double gaussian(double distance, double sigma) {
  return std::exp(-distance * distance / (sigma * sigma));
}

// A row of pixels at half their size.
std::vector<double> refined(const std::vector<double>& pixels, const Weights& weights) {
  constexpr std::size_t before = taps_before, beside = refinement_taps / 2;
  std::vector<double> finer(2 * pixels.size());
  for (std::size_t x = beside; x + beside < pixels.size(); ++x) {
    for (std::size_t k = 0; k < weights.size(); ++k) {
      finer[2 * x + 1] += weights[k] * pixels[x + k - before];
      finer[2 * x] += weights[k] * pixels[x + before - k];
    }
  }
  return finer;
}

// After six refinements one after the other, of one axis.
double largest_error_of_all(const Weights& weights, double sigma, double center) {
  constexpr std::size_t count = 96;
  std::vector<double> pixels(count);
  for (std::size_t x = 0; x < count; ++x)
    pixels[x] = gaussian(static_cast<double>(x) - count / 2 - center, sigma);
  double largest = 0;
  for (int level = 1; level <= 6; ++level) {
    pixels = refined(pixels, weights);
    const double size = std::ldexp(1.0, -level);
    for (std::size_t x = 0; x < pixels.size(); ++x) {
      const double place = (static_cast<double>(x) + 0.5) * size - 0.5 - count / 2;
      if (std::abs(place) < 15)
        largest = std::max(largest, std::abs(pixels[x] - gaussian(place - center, sigma)));
    }
  }
  return largest;
}

double largest_error_of_all(const Weights& weights, double sigma) {
  double largest = 0;
  for (double center = -0.5; center <= 0.5; center += 0.1)
    largest = std::max(largest, largest_error_of_all(weights, sigma, center));
  return largest;
}

TEST(RefinementFilter, KeepsEvenLightEven) {
  for (const double error : {6e-4, 1e-4, 1e-5, 1e-6, 1e-7}) {
    double sum = 0;
    for (const double weight : choose_refinement(error).weights)
      sum += weight;
    EXPECT_NEAR(sum, 1, 2e-9) << error;
  }
}

// What least squares change are tenth differences.
TEST(RefinementFilter, IsExactForPolynomialsOfDegreeNine) {
  const Weights weights = choose_refinement(1e-4).weights;
  for (int degree = 0; degree <= 9; ++degree) {
    double interpolated = 0;
    for (std::size_t k = 0; k < weights.size(); ++k)
      interpolated += weights[k] * std::pow((static_cast<double>(k) - taps_before) / 8, degree);
    EXPECT_NEAR(interpolated, std::pow(0.25 / 8, degree), 1e-12) << degree;
  }
}

TEST(RefinementFilter, KeepsTheErrorOfAllRefinementsOverBothAxesAtTheSmallestWidth) {
  for (const double error : {1e-3, 6e-4, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 1e-7, 1e-8}) {
    const RefinementFilter filter = choose_refinement(error);
    EXPECT_LT(2 * largest_error_of_all(filter.weights, filter.smallest_sigma), error);
  }
}

// The next width of the table is at most a twentieth wider, and errors fall as sigma^-12.
TEST(RefinementFilter, CarriesSplatsNotMuchWiderThanTheErrorNeeds) {
  for (const double error : {6e-4, 1e-4, 1e-5, 2e-6}) {
    const RefinementFilter filter = choose_refinement(error);
    EXPECT_GT(2 * largest_error_of_all(filter.weights, 0.92 * filter.smallest_sigma), error);
  }
}

TEST(RefinementFilter, BestOneErrsByNoMoreThanStatedInAllRefinementsTogether) {
  for (const double sigma : {1.9, 2.0, 2.11, 2.2, 2.35, 2.5, 2.8, 3.1, 3.5, 4.0}) {
    const RefinementOfSigma best = best_refinement(sigma);
    EXPECT_LT(2 * largest_error_of_all(best.filter.weights, sigma), best.error) << sigma;
  }
}

// GridPyramid::wider_for: a splat of peak P is P^(1/8) times wider.
TEST(RefinementFilter, ErrsByNoMoreForBrightSplatsThatAreWiderByTheEighthRoot) {
  for (const double sigma : {1.9, 2.11, 2.5, 2.8}) {
    const RefinementOfSigma best = best_refinement(sigma);
    for (double wider = 1; wider <= 4; wider *= 1.1892) {
      EXPECT_LT(2 * std::pow(wider, 8) * largest_error_of_all(best.filter.weights, wider * sigma),
                1.05 * best.error)
          << sigma << " " << wider;
    }
  }
}

}  // namespace
}  // namespace splotchcl
