#include "scene/flight.h"

#include <algorithm>
#include <boost/qvm/quat_operations.hpp>
#include <boost/qvm/quat_vec_operations.hpp>
#include <cmath>
#include <cstddef>
#include <utility>

#include "scene/constants.h"
#include "scene/spline.h"

namespace splotchcl {
namespace {

// Steps of a segment whose lengths are added up. Between them the speed is constant in the
// parameter, which leaves its variation over 1/256 of a segment.
constexpr std::size_t steps_per_segment = 256;

using boost::qvm::mag;
using boost::qvm::normalized;

Vec3 beyond(const Vec3& end, const Vec3& inner) {
  return 2.0 * end - inner;
}

}  // namespace

Vec3 turned(const Vec3& point, const Vec3& center, const Vec3& axis, double degrees) {
  const auto rotation = boost::qvm::rot_quat(normalized(axis), degrees * pi / 180);
  return center + rotation * Vec3(point - center);
}

Flight::Flight(std::vector<Vec3> points) : points_(std::move(points)), lengths_{0} {
  const std::size_t last = points_.size() - 1;
  for (std::size_t i = 0; i < last; ++i) {
    const Vec3 before = i > 0 ? points_[i - 1] : beyond(points_[0], points_[1]);
    const Vec3 after = i + 2 <= last ? points_[i + 2] : beyond(points_[last], points_[last - 1]);
    const Vec3 &from = points_[i], &to = points_[i + 1];
    const double width_before = std::sqrt(mag(from - before));
    const double width = std::sqrt(mag(to - from));
    const double width_after = std::sqrt(mag(after - to));
    const auto slope = [](const Vec3& a, const Vec3& b, const Vec3& c, double ab, double bc) {
      return Vec3((b - a) / ab - (c - a) / (ab + bc) + (c - b) / bc);
    };
    leaving_.push_back(width * slope(before, from, to, width_before, width));
    arriving_.push_back(width * slope(from, to, after, width, width_after));
  }
  for (std::size_t i = 0; i < last; ++i) {
    Vec3 previous = points_[i];
    for (std::size_t step = 1; step <= steps_per_segment; ++step) {
      const double t = static_cast<double>(step) / steps_per_segment;
      const Vec3 next = on_segment(i, t).position;
      lengths_.push_back(lengths_.back() + mag(next - previous));
      previous = next;
    }
  }
}

Flight::State Flight::at(double fraction) const {
  const double along = fraction * length();
  const std::size_t step = find_interval(lengths_, along);
  const double width = lengths_[step + 1] - lengths_[step];
  const double part = width > 0 ? std::clamp((along - lengths_[step]) / width, 0.0, 1.0) : 0;
  const double t = (static_cast<double>(step % steps_per_segment) + part) / steps_per_segment;
  return on_segment(step / steps_per_segment, t);
}

Flight::State Flight::on_segment(std::size_t segment, double t) const {
  const Vec3 &from = points_[segment], &to = points_[segment + 1];
  const Vec3 &leaving = leaving_[segment], &arriving = arriving_[segment];
  const double s = 1 - t;
  const Vec3 step = to - from;
  const Vec3 position = from + t * t * (3 - 2 * t) * step + t * s * (s * leaving - t * arriving);
  const Vec3 velocity =
      6 * t * s * step + (s * (s - 2 * t)) * leaving + (t * (t - 2 * s)) * arriving;
  return {position, normalized(velocity)};
}

}  // namespace splotchcl
