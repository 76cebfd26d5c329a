#include "scene/direction_track.h"

#include <boost/qvm/quat_access.hpp>
#include <boost/qvm/quat_operations.hpp>
#include <boost/qvm/quat_vec_operations.hpp>
#include <cmath>
#include <cstddef>
#include <utility>

#include "scene/spline.h"

namespace splotchcl {
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

}  // namespace splotchcl
