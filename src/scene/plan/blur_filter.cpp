#include "scene/plan/blur_filter.h"

#include <algorithm>
#include <cmath>

namespace splotchcl {
namespace {

constexpr double pi2 = 9.869604401089358;

// A Gaussian r sampled at whole pixels and blurred by a sampled b repeats its spectrum at
// every whole frequency. The first repetition, seen through the other's spectrum, has
// exp(-pi^2 r^2 b^2 / (r^2 + b^2)) of the peak: on either side, for either of the two, on
// both axes.
constexpr double repetitions = 8;

// r^2 b^2 / (r^2 + b^2) that keeps the error.
double needed_product(double error) {
  return std::max(0.5, std::log(repetitions / error) / pi2);
}

}  // namespace

double largest_blur(double smallest_sigma, double error) {
  // With r^2 + b^2 = sigma^2 the larger root of b^2 (sigma^2 - b^2) = product sigma^2.
  const double sigma2 = smallest_sigma * smallest_sigma;
  const double product = needed_product(error);
  return 0.5 * (sigma2 + std::sqrt(std::max(0.0, sigma2 * (sigma2 - 4 * product))));
}

double smallest_blurred_sigma(double error) {
  return 2 * std::sqrt(needed_product(error));
}

int blur_reach(double sigma2, double error) {
  const double sigma = std::sqrt(sigma2);
  int reach = 1;
  while (2 * std::erfc((reach + 0.5) / sigma) > error)
    ++reach;
  return reach;
}

std::vector<float> blur_weights(double sigma2, double error) {
  const int half_width = blur_reach(sigma2, error);
  std::vector<double> weights;
  double sum = 0;
  for (int k = -half_width; k <= half_width; ++k) {
    weights.push_back(std::exp(-k * k / sigma2));
    sum += weights.back();
  }
  std::vector<float> normalized;
  for (const double weight : weights)
    normalized.push_back(static_cast<float>(weight / sum));
  return normalized;
}

}  // namespace splotchcl
