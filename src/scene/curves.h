#pragma once

#include <boost/qvm/quat.hpp>
#include <vector>

#include "splotchcl/vector.h"

namespace splotchcl {

// How values between knots are found:
//   linear     straight lines
//   natural    the cubic spline with continuous second derivative, zero at both ends: the
//              smoothest motion, which may swing beyond its knots
//   monotone   cubics after Fritsch & Carlson (SIAM J. Numer. Anal. 17, 238, 1980): between
//              two knots the value never leaves the interval of theirs
enum class SplineKind { linear, natural, monotone };

// A curve through values at given places; before the first and after the last it stays
// what it is there.
class Spline {
 public:
  // `knots` increase strictly; as many values, at least one.
  Spline(std::vector<double> knots, std::vector<double> values, SplineKind kind);

  double at(double place) const;

 private:
  std::vector<double> knots_, values_;
  std::vector<double> slopes_;  // at the knots; empty: straight lines
};

// The interval of `knots`, at least two, that holds `place`, by its first knot's index.
// Places beyond the ends belong to the outermost intervals.
std::size_t find_interval(const std::vector<double>& knots, double place);

// A direction that turns from each of the given ones to the next by the smallest rotation,
// with continuous angular velocity: a cubic Bezier curve of unit quaternions after Shoemake
// (SIGGRAPH 1985) and Kim, Kim & Shin (SIGGRAPH 1995), with the angular velocity at a knot
// weighted from its two sides. Turning at a constant rate about one axis comes out as that.
class DirectionTrack {
 public:
  // `knots` increase strictly; as many directions, at least one, none of them zero. With
  // `is_smooth` false each turn has a constant rate of its own.
  DirectionTrack(std::vector<double> knots, const std::vector<Vec3>& directions, bool is_smooth);

  Vec3 at(double place) const;  // of unit length

 private:
  using Quaternion = boost::qvm::quat<double>;

  std::vector<double> knots_;
  Vec3 first_;                         // of unit length
  std::vector<Quaternion> rotations_;  // from the first direction to each
  std::vector<Vec3> velocities_;       // angular, half of it, in the rotated frame
};

// A point turned about the axis through `center`, counterclockwise seen from the axis' tip.
// The axis has any length but zero.
Vec3 turned(const Vec3& point, const Vec3& center, const Vec3& axis, double degrees);

// A curve through points, run through at constant speed: a centripetal Catmull-Rom spline
// (Yuksel, Schaefer & Keyser, Computer-Aided Design 43, 747, 2011), which has neither cusps
// nor loops between two points.
class Flight {
 public:
  struct State {
    Vec3 position;
    Vec3 direction;  // of unit length
  };

  // At least two points, each different from the one before.
  explicit Flight(std::vector<Vec3> points);

  double length() const { return lengths_.back(); }
  // At this part of the whole length, from 0 to 1.
  State at(double fraction) const;

 private:
  State on_segment(std::size_t segment, double t) const;

  std::vector<Vec3> points_;
  std::vector<Vec3> leaving_, arriving_;  // derivatives at a segment's ends
  std::vector<double> lengths_;           // from the start to each of the steps
};

}  // namespace splotchcl
