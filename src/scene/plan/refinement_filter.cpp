#include "scene/plan/refinement_filter.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace splotchcl {
namespace {

// Minimax over all phases of a Gaussian of sigma 2, with an error of at most 4e-5 at sigma 4
// (scripts/design_refinement.py, which finds weights within 2.1e-5 of these and the same largest
// error). Per axis a refinement errs by 1.7e-4 of the peak at sigma 2, and where sigma has doubled
// with each further one by 4.0e-5, 3.1e-5, 1.3e-5 and ever less: together at most 1.0e-4.
constexpr std::array<double, 10> minimax_weights = {
    0.00283293931, -0.0155961976, 0.0504577231, -0.143700312,  0.884471756,
    0.292573146,   -0.100249456,  0.0396250615, -0.0127252842, 0.00231062281};
constexpr double minimax_sigma = 2;
constexpr double minimax_error = 2 * (1.7e-4 + 1.0e-4);

// Interpolation by the polynomial through the ten pixels: its error falls as sigma^-10.
std::array<double, 10> lagrange_weights() {
  std::array<double, 10> weights;
  for (int i = -4; i <= 5; ++i) {
    double weight = 1;
    for (int j = -4; j <= 5; ++j) {
      if (j != i) weight *= (0.25 - j) / (i - j);
    }
    weights[static_cast<std::size_t>(i + 4)] = weight;
  }
  return weights;
}
// Per axis the error is constant / sigma^10: 3.5 is the constant of sigma 4.1, 5.2 that of
// ever wider splats.
constexpr double lagrange_constant = 3.5;

double lagrange_error(double sigma) {
  return 2 * lagrange_constant / std::pow(sigma, 10);
}

// Six refinements, one after the other, of both axes together: measured at all phases, and rounded
// up (docs/accuracy.md). Of wider ones the last is the largest.
struct ErrorFrom {
  double sigma, error;
};
constexpr std::array<ErrorFrom, 6> minimax_errors = {
    {{2, 6.3e-4}, {2.11, 3.7e-4}, {2.2, 2.6e-4}, {2.3, 2.0e-4}, {2.5, 1.7e-4}, {2.8, 1.4e-4}}};

double error_of_minimax(double sigma) {
  double error = 1;
  for (const ErrorFrom& from : minimax_errors) {
    if (sigma >= from.sigma) error = from.error;
  }
  return error;
}

}  // namespace

RefinementOfSigma best_refinement(double sigma) {
  const double minimax = error_of_minimax(sigma), lagrange = lagrange_error(sigma);
  return minimax <= lagrange ? RefinementOfSigma{{minimax_weights, sigma}, minimax}
                             : RefinementOfSigma{{lagrange_weights(), sigma}, lagrange};
}

RefinementFilter choose_refinement(double error) {
  if (minimax_error <= error) return {minimax_weights, minimax_sigma};
  const double sigma = std::pow(2 * lagrange_constant / std::max(error, 1e-12), 0.1);
  return {lagrange_weights(), std::max(sigma, minimax_sigma)};
}

}  // namespace splotchcl
