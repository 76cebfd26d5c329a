#include "cells/gaussian.h"

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>

#include "scene/constants.h"

namespace splotchcl {
namespace {

using namespace boost::qvm;

const double root_of_pi = std::sqrt(pi);

// exp(-a^2) - exp(-b^2) over 4 r R, for a = R - r and b = R + r: sinh has no digits left where it
// is small.
double shell_density(double r, double radius) {
  const double product = 4 * r * radius, away = radius - r;
  const double part = product > 1e-8 ? -std::expm1(-product) / product : 1 - 0.5 * product;
  return std::exp(-away * away) * part;
}

// How much lies at the distance `radius` per distance, all in sigma.
double per_radius(double r, double radius) {
  return 4 / root_of_pi * radius * radius * shell_density(r, radius);
}

// How much lies within `radius`, in sigma.
double within(double r, double radius) {
  const double edges = 0.5 * (std::erf(radius + r) + std::erf(radius - r));
  return edges - 2 * radius / root_of_pi * shell_density(r, radius);
}

// By six points of Gauss and Legendre.
double integral_over(double r, double low, double high) {
  constexpr double nodes[] = {0.2386191860831969, 0.6612093864662645, 0.9324695142031521};
  constexpr double weights[] = {0.4679139345726910, 0.3607615730481386, 0.1713244923791704};
  const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
  double sum = 0;
  for (int i = 0; i < 3; ++i)
    sum += weights[i] *
           (per_radius(r, middle - half * nodes[i]) + per_radius(r, middle + half * nodes[i]));
  return half * sum;
}

}  // namespace

double gaussian_between(double low, double high, double sigma) {
  const double a = low / sigma, b = high / sigma;
  if (a >= 0) return 0.5 * (std::erfc(a) - std::erfc(b));
  if (b <= 0) return 0.5 * (std::erfc(-b) - std::erfc(-a));
  return 1 - 0.5 * (std::erfc(-a) + std::erfc(b));
}

double gaussian_in_shell(double distance, double low, double high, double sigma) {
  const double r = distance / sigma;
  const double from = std::max(low / sigma, r - kernel_reach);
  const double to = std::min(high / sigma, r + kernel_reach);
  if (!(to > from)) return 0;
  constexpr double narrow = 0.5;
  if (to - from < narrow) return integral_over(r, from, to);
  return within(r, to) - within(r, from);
}

GaussianOnSky::GaussianOnSky(const Vec3& place, double sigma)
    : middle_({{1, 0, 0}}), distance_(mag(place) / sigma) {
  if (distance_ > 0) middle_ = place / mag(place);
  width_ = distance_ > 1 ? 1 / distance_ : 1;
}

double GaussianOnSky::reach_of(double square) const {
  const double reach = std::min(std::sqrt(square), kernel_reach);
  // Behind the origin lies as much as at this distance.
  return distance_ > reach ? std::asin(reach / distance_) : pi;
}

double GaussianOnSky::square(const Vec3& direction) const {
  const Vec3 across = cross(middle_, direction);
  const double beside = mag_sqr(across);
  const double along = dot(middle_, direction);
  // Behind the origin there is less still.
  return distance_ * distance_ * (along > 0 ? beside : 1);
}

// The integral of the kernel along the line of sight times the square of the distance. With
// m = r cos(theta) / sigma: exp(-r^2 sin^2(theta) / sigma^2) / pi^1.5 times
// sqrt(pi)/2 (m^2 + 1/2) erfc(-m) + m/2 exp(-m^2).
double GaussianOnSky::operator()(const Vec3& direction) const {
  const double beside = distance_ * distance_ * mag_sqr(cross(middle_, direction));
  if (beside > kernel_reach * kernel_reach) return 0;
  const double m = distance_ * dot(middle_, direction);
  if (m < -kernel_reach) return 0;
  const double unit = std::exp(-beside) / (pi * root_of_pi);
  if (m > kernel_reach) return unit * root_of_pi * (m * m + 0.5);
  return unit * (0.5 * root_of_pi * (m * m + 0.5) * std::erfc(-m) + 0.5 * m * std::exp(-m * m));
}

namespace {

// `from` is the particle's place from the first edge.
void add_row(const CellsAlongAxis& cells, double from, double sigma,
             std::vector<SharesAlongAxis>& rows) {
  const double reach = kernel_reach * sigma, last = cells.count;
  const double low = std::clamp(std::floor((from - reach) / cells.width), 0.0, last);
  const double high = std::clamp(std::floor((from + reach) / cells.width) + 1, 0.0, last);
  if (!(high > low)) return;
  SharesAlongAxis row;
  row.first = static_cast<int>(low);
  for (double cell = low; cell < high; ++cell)
    row.parts.push_back(
        gaussian_between(cell * cells.width - from, (cell + 1) * cells.width - from, sigma));
  rows.push_back(std::move(row));
}

}  // namespace

void find_shares_along_axis(const CellsAlongAxis& cells, double place, double sigma,
                            std::vector<SharesAlongAxis>& rows) {
  rows.clear();
  const double from = place - cells.first;
  if (!cells.period) {
    add_row(cells, from, sigma, rows);
    return;
  }
  const double period = *cells.period, reach = kernel_reach * sigma;
  const double first = std::ceil((-reach - from) / period);
  const double last = std::floor((cells.count * cells.width + reach - from) / period);
  for (double image = first; image <= last; ++image)
    add_row(cells, from + image * period, sigma, rows);
}

}  // namespace splotchcl
