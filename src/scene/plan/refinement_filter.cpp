#include "scene/plan/refinement_filter.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace splotchcl {
namespace {

// Minimax over Gaussians of sigma >= 2 at any phase (scripts/design_refinement.py). Per
// axis: 1.7e-4 of the peak at sigma 2, and at most 1.0e-4, 5e-5, 4e-5 after one, two and
// more further refinements, where sigma has doubled each time.
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
constexpr double lagrange_constant = 3.5;  // error = constant / sigma^10 per axis

}  // namespace

RefinementFilter choose_refinement(double error) {
  if (minimax_error <= error) return {minimax_weights, minimax_sigma};
  const double sigma = std::pow(2 * lagrange_constant / std::max(error, 1e-12), 0.1);
  return {lagrange_weights(), std::max(sigma, minimax_sigma)};
}

}  // namespace splotchcl
