// The weights by which coarse grids are refined err by no more than docs/accuracy.md and the
// budget of coarse grids say.
#include "scene/plan/refinement_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace splotchcl {
namespace {

using Weights = std::array<double, 10>;

// An error that the minimax weights keep, and the Lagrange weights' own.
constexpr double coarse = 6e-4, fine = 1e-5;

double gaussian(double distance, double sigma) {
  return std::exp(-distance * distance / (sigma * sigma));
}

// Of the interpolation a quarter of a pixel right of pixel 0, for a Gaussian at `center`.
double error_at(const Weights& weights, double sigma, double center) {
  double interpolated = 0;
  for (std::size_t k = 0; k < weights.size(); ++k)
    interpolated += weights[k] * gaussian(static_cast<double>(k) - 4 - center, sigma);
  return std::abs(interpolated - gaussian(0.25 - center, sigma));
}

double largest_error(const Weights& weights, double sigma) {
  double largest = 0;
  const double reach = 6 + 4 * sigma, step = 0.002 * sigma;
  for (double center = -reach; center <= reach; center += step)
    largest = std::max(largest, error_at(weights, sigma, center));
  return largest;
}

TEST(RefinementFilter, KeepsEvenLightEven) {
  for (const double error : {coarse, fine}) {
    double sum = 0;
    for (const double weight : choose_refinement(error).weights)
      sum += weight;
    EXPECT_NEAR(sum, 1, 2e-9);
  }
}

TEST(RefinementFilter, TakesMinimaxWeightsFromTwoPixelsOnWhereTheErrorAllowsThem) {
  EXPECT_EQ(choose_refinement(5.5e-4).smallest_sigma, 2);
  EXPECT_GT(choose_refinement(5.3e-4).smallest_sigma, 2);
}

TEST(RefinementFilter, MinimaxWeightsErrAsStatedAtTwoPixelsAndAfterEachFurtherRefinement) {
  const Weights weights = choose_refinement(coarse).weights;
  EXPECT_LT(largest_error(weights, 2), 1.74e-4);
  EXPECT_LT(largest_error(weights, 4), 4.01e-5);
  EXPECT_LT(largest_error(weights, 8), 3.06e-5);
  EXPECT_LT(largest_error(weights, 16), 1.30e-5);
}

TEST(RefinementFilter, MinimaxWeightsErrLessTheWiderTheSplats) {
  const Weights weights = choose_refinement(coarse).weights;
  double narrower = largest_error(weights, 2);
  for (double sigma = 2.1; sigma < 40; sigma *= 1.05) {
    const double error = largest_error(weights, sigma);
    EXPECT_LT(error, narrower) << "sigma " << sigma;
    narrower = error;
  }
}

TEST(RefinementFilter, AllFurtherRefinementsErrByNoMoreThanStatedTogether) {
  const Weights weights = choose_refinement(coarse).weights;
  double sum = 0;
  for (double sigma = 4; sigma <= 4096; sigma *= 2)
    sum += largest_error(weights, sigma);
  EXPECT_LT(sum, 1.0e-4);
}

// The constant grows from 1.2 at 2 pixels to the 5.2 of ever wider splats.
TEST(RefinementFilter, LagrangeWeightsErrByTheTenthPowerOfTheWidth) {
  const Weights weights = choose_refinement(fine).weights;
  for (const double sigma : {2.0, 2.5, 3.0, 3.5, 4.0})
    EXPECT_LT(largest_error(weights, sigma), 3.5 / std::pow(sigma, 10)) << "sigma " << sigma;
  for (const double sigma : {5.0, 6.0, 8.0, 12.0})
    EXPECT_LT(largest_error(weights, sigma), 5.21 / std::pow(sigma, 10)) << "sigma " << sigma;
}

// A row of pixels at half their size.
std::vector<double> refined(const std::vector<double>& pixels, const Weights& weights) {
  std::vector<double> finer(2 * pixels.size());
  for (std::size_t x = 5; x + 5 < pixels.size(); ++x) {
    for (std::size_t k = 0; k < weights.size(); ++k) {
      finer[2 * x + 1] += weights[k] * pixels[x + k - 4];
      finer[2 * x] += weights[k] * pixels[x + 4 - k];
    }
  }
  return finer;
}

// After six refinements one after the other, of one axis.
double largest_error_of_all(const Weights& weights, double sigma, double center) {
  constexpr std::size_t count = 64;
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

TEST(RefinementFilter, BestOneErrsByNoMoreThanStatedInAllRefinementsTogether) {
  for (const double sigma : {2.0, 2.11, 2.2, 2.3, 2.5, 2.8, 3.1}) {
    const RefinementOfSigma best = best_refinement(sigma);
    for (double center = -0.5; center <= 0.5; center += 0.05)
      EXPECT_LT(2 * largest_error_of_all(best.filter.weights, sigma, center), best.error) << sigma;
  }
}

TEST(RefinementFilter, LagrangeWeightsKeepTheErrorOverBothAxesAtTheSmallestWidth) {
  for (const double error : {1e-4, 1e-5}) {
    const RefinementFilter filter = choose_refinement(error);
    EXPECT_LT(2 * largest_error(filter.weights, filter.smallest_sigma), error);
  }
}

}  // namespace
}  // namespace splotchcl
