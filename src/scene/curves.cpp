#include "scene/curves.h"

#include <algorithm>
#include <boost/qvm/quat_access.hpp>
#include <boost/qvm/quat_operations.hpp>
#include <boost/qvm/quat_vec_operations.hpp>
#include <cmath>
#include <cstddef>
#include <utility>

#include "scene/constants.h"

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

namespace {

using boost::qvm::cross;
using boost::qvm::dot;
using boost::qvm::mag;
using boost::qvm::normalized;
using Quaternion = boost::qvm::quat<double>;

// exp of a pure quaternion: a rotation by twice its length about it.
Quaternion exponential(const Vec3& v) {
  const double angle = mag(v);
  const double factor = angle > 0 ? std::sin(angle) / angle : 1;
  return {{std::cos(angle), factor * v.a[0], factor * v.a[1], factor * v.a[2]}};
}

Vec3 logarithm(const Quaternion& q) {
  const Vec3 v = {{q.a[1], q.a[2], q.a[3]}};
  const double sine = mag(v);
  const double factor = sine > 0 ? std::atan2(sine, q.a[0]) / sine : 1;
  return factor * v;
}

Quaternion between(const Quaternion& from, const Quaternion& to, double fraction) {
  return from * exponential(fraction * logarithm(conjugate(from) * to));
}

Vec3 any_perpendicular(const Vec3& v) {
  const Vec3 x = {{1, 0, 0}}, y = {{0, 1, 0}};
  return cross(v, std::abs(v.a[0]) < 0.7 ? x : y);
}

// The smallest rotation that takes one unit vector to another.
Quaternion smallest_rotation(const Vec3& from, const Vec3& to) {
  const Vec3 axis = cross(from, to);
  const double sine = mag(axis);
  const double half_angle = 0.5 * std::atan2(sine, dot(from, to));
  if (sine > 0) return exponential(half_angle / sine * axis);
  // The same direction, or the opposite one, which any half turn reaches.
  return exponential(half_angle * normalized(any_perpendicular(from)));
}

}  // namespace

DirectionTrack::DirectionTrack(std::vector<double> knots, const std::vector<Vec3>& directions,
                               bool is_smooth)
    : knots_(std::move(knots)), first_(normalized(directions.front())) {
  rotations_.push_back(boost::qvm::identity_quat<double>());
  for (std::size_t i = 1; i < directions.size(); ++i) {
    const Quaternion turn =
        smallest_rotation(normalized(directions[i - 1]), normalized(directions[i]));
    rotations_.push_back(turn * rotations_.back());
  }
  if (!is_smooth || rotations_.size() < 2) return;
  std::vector<Vec3> rates;  // of the intervals
  std::vector<double> widths;
  for (std::size_t i = 0; i + 1 < rotations_.size(); ++i) {
    widths.push_back(knots_[i + 1] - knots_[i]);
    rates.push_back(logarithm(conjugate(rotations_[i]) * rotations_[i + 1]) / widths.back());
  }
  velocities_.push_back(rates.front());
  for (std::size_t i = 1; i < rates.size(); ++i) {
    velocities_.push_back((widths[i] * rates[i - 1] + widths[i - 1] * rates[i]) /
                          (widths[i - 1] + widths[i]));
  }
  velocities_.push_back(rates.back());
}

Vec3 DirectionTrack::at(double place) const {
  if (knots_.size() == 1 || !(place > knots_.front())) return first_;
  if (!(place < knots_.back())) return rotations_.back() * first_;
  const std::size_t i = find_interval(knots_, place);
  const double width = knots_[i + 1] - knots_[i];
  const double t = (place - knots_[i]) / width;
  const Quaternion &from = rotations_[i], &to = rotations_[i + 1];
  if (velocities_.empty()) return between(from, to, t) * first_;
  const Quaternion leaving = from * exponential(width / 3 * velocities_[i]);
  const Quaternion arriving = to * exponential(-width / 3 * velocities_[i + 1]);
  const Quaternion middle = between(leaving, arriving, t);
  const Quaternion first = between(between(from, leaving, t), middle, t);
  const Quaternion second = between(middle, between(arriving, to, t), t);
  return normalized(between(first, second, t) * first_);
}

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
