#include "scene/plan/grid_filters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

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

constexpr std::size_t taps = refinement_taps;
using TapWeights = SmallVector<taps>;

// Old pixels from the first tap on; where the new one lies.
constexpr int first_pixel = 1 - static_cast<int>(taps) / 2;
constexpr double new_pixel = 0.25;

// Interpolation by the polynomial through so many pixels around the new one.
TapWeights lagrange_weights(int pixels) {
  TapWeights weights{};
  const int first = 1 - pixels / 2, last = pixels / 2;
  for (int i = first; i <= last; ++i) {
    double weight = 1;
    for (int j = first; j <= last; ++j) {
      if (j != i) weight *= (new_pixel - j) / (i - j);
    }
    weights[static_cast<std::size_t>(i - first_pixel)] = weight;
  }
  return weights;
}

// Weights that interpolate polynomials of degree 9, as those through ten pixels do, differ from
// them by sums of tenth differences, of which sixteen pixels have six.
constexpr int exact_pixels = 10;
constexpr std::size_t changes = taps - exact_pixels;
std::array<TapWeights, changes> tenth_differences() {
  constexpr std::array<double, exact_pixels + 1> binomials = {1,   10,  45, 120, 210, 252,
                                                              210, 120, 45, 10,  1};
  std::array<TapWeights, changes> differences{};
  for (std::size_t first = 0; first < changes; ++first) {
    for (std::size_t k = 0; k < binomials.size(); ++k)
      differences[first][first + k] = (k % 2 == 0 ? 1 : -1) * binomials[k] / binomials[5];
  }
  return differences;
}

// Of Gaussians `distance` apart the integral of their product, but for a factor: a sum over an
// octave of widths from sigma on, of which wider ones count more, so that errors fall at least as
// sigma^-8 (the amplitudes of brighter splats, GridPyramid::wider_for).
double overlap(double distance, double sigma) {
  constexpr int steps = 4;
  constexpr double power = 16;
  double sum = 0;
  for (int step = 0; step <= steps; ++step) {
    const double wider = std::exp2(static_cast<double>(step) / steps), width = wider * sigma;
    sum += std::pow(wider, power) * std::exp(-distance * distance / (2 * width * width));
  }
  return sum;
}

// The least integral of the squared error over all places of a Gaussian: of the weights w with
// differences D and their amounts z, D' A D z = D' (b - A w).
TapWeights least_squares_weights(double sigma) {
  const TapWeights exact = lagrange_weights(exact_pixels);
  const std::array<TapWeights, changes> differences = tenth_differences();
  TapWeights at_distance{}, wanted{};
  for (std::size_t i = 0; i < taps; ++i) {
    at_distance[i] = overlap(static_cast<double>(i), sigma);
    wanted[i] = overlap(static_cast<double>(i) + first_pixel - new_pixel, sigma);
  }
  SmallMatrix<taps> products{};
  for (std::size_t i = 0; i < taps; ++i) {
    for (std::size_t k = 0; k < taps; ++k)
      products[i][k] = at_distance[i > k ? i - k : k - i];
  }
  const TapWeights found = times(products, exact);
  SmallMatrix<changes> matrix{};
  SmallVector<changes> missing{};
  for (std::size_t a = 0; a < changes; ++a) {
    const TapWeights of_change = times(products, differences[a]);
    for (std::size_t i = 0; i < taps; ++i) {
      missing[a] += differences[a][i] * (wanted[i] - found[i]);
      for (std::size_t b = 0; b < changes; ++b)
        matrix[b][a] += differences[b][i] * of_change[i];
    }
  }
  const SmallVector<changes> amounts = times(inverse_of(matrix), missing);
  TapWeights weights = exact;
  for (std::size_t a = 0; a < changes; ++a) {
    for (std::size_t i = 0; i < taps; ++i)
      weights[i] += amounts[a] * differences[a][i];
  }
  return weights;
}

// Six refinements, one after the other, of both axes together: measured at all phases, and rounded
// up (docs/dev/accuracy.md). Of wider ones the last is the largest.
struct ErrorFrom {
  double sigma, error;
};

constexpr std::array<ErrorFrom, 16> least_squares_errors = {{{1.8, 9.8e-4},
                                                             {1.85, 7.2e-4},
                                                             {1.9, 5.2e-4},
                                                             {1.95, 3.8e-4},
                                                             {2, 2.8e-4},
                                                             {2.05, 2.1e-4},
                                                             {2.11, 1.45e-4},
                                                             {2.2, 8.5e-5},
                                                             {2.3, 4.8e-5},
                                                             {2.4, 2.7e-5},
                                                             {2.5, 1.55e-5},
                                                             {2.6, 9.2e-6},
                                                             {2.7, 5.4e-6},
                                                             {2.8, 3.3e-6},
                                                             {2.9, 2.0e-6},
                                                             {3, 1.25e-6}}};

// Beyond, sums of squares are too small for double precision, and weights are Lagrange's: their
// error falls as sigma^-16, with constants from 650 at 3.5 pixels to 1860 at 9, where it is 1e-12.
constexpr double lagrange_constant = 2000, lagrange_power = 16;

double lagrange_error(double sigma) {
  return lagrange_constant / std::pow(sigma, lagrange_power);
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

RefinementOfSigma best_refinement(double sigma) {
  const double lagrange = lagrange_error(sigma);
  double error = 1, designed = sigma;
  for (const ErrorFrom& from : least_squares_errors) {
    if (sigma < from.sigma) break;
    error = from.error;
    designed = from.sigma;
  }
  return lagrange < error ? RefinementOfSigma{{lagrange_weights(taps), sigma}, lagrange}
                          : RefinementOfSigma{{least_squares_weights(designed), sigma}, error};
}

RefinementFilter choose_refinement(double error) {
  for (const ErrorFrom& from : least_squares_errors) {
    if (from.error <= error) return {least_squares_weights(from.sigma), from.sigma};
  }
  const double sigma = std::pow(lagrange_constant / std::max(error, 1e-12), 1 / lagrange_power);
  return {lagrange_weights(taps), sigma};
}

}  // namespace splotchcl
