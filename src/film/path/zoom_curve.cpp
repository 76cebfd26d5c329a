#include "film/path/zoom_curve.h"

#include <cmath>

namespace splotchcl {
namespace {

// How much moving counts beside scaling: rho^2 of the paper.
constexpr double weight = 2;
const double root = std::sqrt(weight);

}  // namespace

ZoomCurve::ZoomCurve(double first_width, double last_width, double distance)
    : first_width_(first_width), last_width_(last_width), distance_(distance) {
  constexpr double hardly = 1e-9;
  if (distance_ <= hardly * first_width_) {
    distance_ = 0;
    return;
  }
  const double widths = last_width * last_width - first_width * first_width;
  const double moved = weight * weight * distance * distance;
  const auto place = [&](double width, double sum) {
    return std::asinh(-sum / (2 * width * weight * distance));
  };
  first_ = place(first_width, widths + moved);
  length_ = (place(last_width, widths - moved) - first_) / root;
}

ZoomCurve::View ZoomCurve::at(double fraction) const {
  if (fraction >= 1) return {1, last_width_};
  if (distance_ == 0) {
    return {fraction, first_width_ * std::pow(last_width_ / first_width_, fraction)};
  }
  const double place = root * fraction * length_ + first_;
  // sinh(place - first) / cosh(place) is cosh(first) tanh(place) - sinh(first), without its
  // cancellation.
  const double moved = first_width_ / weight * std::sinh(place - first_) / std::cosh(place);
  return {moved / distance_, first_width_ * std::cosh(first_) / std::cosh(place)};
}

}  // namespace splotchcl
