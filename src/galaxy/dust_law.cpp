#include "galaxy/dust_law.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "galaxy/even_points.h"

namespace splotchcl {
namespace {

constexpr int knots = 1025;
constexpr double step = 1.0 / 64;

}  // namespace

Veil::Veil(double dust_height, double star_height) {
  constexpr int parts = 64;
  for (int i = 0; i < parts; ++i) {
    const double height = star_height * normal_quantile((i + 0.5) / parts);
    dust_above_.push_back(dust_height > 0 ? 0.5 * std::erfc(height / dust_height * M_SQRT1_2)
                                          : (height < 0 ? 1.0 : 0.0));
  }
  for (int knot = 0; knot < knots; ++knot)
    transmission_.push_back(exact_transmission(knot * step));
}

double Veil::exact_transmission(double depth) const {
  double sum = 0;
  for (const double part : dust_above_)
    sum += std::exp(-depth * part);
  return sum / static_cast<double>(dust_above_.size());
}

double Veil::transmission(double depth) const {
  const double knot = depth / step;
  if (!(knot < knots - 1)) return exact_transmission(depth);
  const auto i = static_cast<std::size_t>(knot);
  const double part = knot - static_cast<double>(i);
  return (1 - part) * transmission_[i] + part * transmission_[i + 1];
}

double Veil::depth(double transmission, double largest) const {
  const auto below =
      std::lower_bound(transmission_.begin(), transmission_.end(), transmission, std::greater<>());
  if (below == transmission_.begin()) return 0;
  if (below == transmission_.end()) return largest;
  const double part = (below[-1] - transmission) / (below[-1] - below[0]);
  const auto i = static_cast<double>(below - transmission_.begin() - 1);
  return std::min(largest, (i + part) * step);
}

}  // namespace splotchcl
