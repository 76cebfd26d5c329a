#include "scene/spline.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace splotchcl {
namespace {

struct Secants {
  std::vector<double> widths, slopes;  // of the intervals
};

Secants secants(const std::vector<double>& knots, const std::vector<double>& values) {
  Secants result;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    result.widths.push_back(knots[i + 1] - knots[i]);
    result.slopes.push_back((values[i + 1] - values[i]) / result.widths.back());
  }
  return result;
}

// Continuity of the second derivative at each inner knot, and a zero one at the ends, is a
// tridiagonal system for the slopes at the knots.
std::vector<double> natural_slopes(const Secants& s) {
  const std::size_t last = s.widths.size();
  std::vector<double> upper(last + 1), slopes(last + 1);
  upper[0] = 0.5;
  slopes[0] = 1.5 * s.slopes[0];
  for (std::size_t i = 1; i < last; ++i) {
    const double before = 1 / s.widths[i - 1], after = 1 / s.widths[i];
    const double pivot = 2 * (before + after) - before * upper[i - 1];
    upper[i] = after / pivot;
    slopes[i] =
        (3 * (before * s.slopes[i - 1] + after * s.slopes[i]) - before * slopes[i - 1]) / pivot;
  }
  slopes[last] = (3 * s.slopes[last - 1] - slopes[last - 1]) / (2 - upper[last - 1]);
  for (std::size_t i = last; i-- > 0;)
    slopes[i] -= upper[i] * slopes[i + 1];
  return slopes;
}

// Flat where the values turn; elsewhere the weighted harmonic mean of the neighbours' secants.
double monotone_slope(const Secants& s, std::size_t knot) {
  const double before = s.slopes[knot - 1], after = s.slopes[knot];
  if (!(before * after > 0)) return 0;
  const double weight_before = 2 * s.widths[knot] + s.widths[knot - 1];
  const double weight_after = s.widths[knot] + 2 * s.widths[knot - 1];
  return (weight_before + weight_after) / (weight_before / before + weight_after / after);
}

std::vector<double> monotone_slopes(const Secants& s) {
  const std::size_t last = s.slopes.size();
  std::vector<double> slopes(last + 1);
  slopes[0] = s.slopes[0];
  slopes[last] = s.slopes[last - 1];
  for (std::size_t i = 1; i < last; ++i)
    slopes[i] = monotone_slope(s, i);
  return slopes;
}

}  // namespace

std::size_t find_interval(const std::vector<double>& knots, double place) {
  const auto after = std::upper_bound(knots.begin() + 1, knots.end() - 1, place);
  return static_cast<std::size_t>(after - knots.begin()) - 1;
}

Spline::Spline(std::vector<double> knots, std::vector<double> values, SplineKind kind)
    : knots_(std::move(knots)), values_(std::move(values)) {
  if (kind == SplineKind::linear || knots_.size() < 2) return;
  const Secants s = secants(knots_, values_);
  slopes_ = kind == SplineKind::natural ? natural_slopes(s) : monotone_slopes(s);
}

double Spline::at(double place) const {
  if (!(place > knots_.front())) return values_.front();
  if (!(place < knots_.back())) return values_.back();
  const std::size_t i = find_interval(knots_, place);
  const double width = knots_[i + 1] - knots_[i];
  const double t = (place - knots_[i]) / width;
  const double step = values_[i + 1] - values_[i];
  if (slopes_.empty()) return values_[i] + t * step;
  // Hermite's form around the first value, so that a constant stays one exactly.
  const double s = 1 - t;
  return values_[i] + step * t * t * (3 - 2 * t) +
         width * t * s * (slopes_[i] * s - slopes_[i + 1] * t);
}

}  // namespace splotchcl
