#pragma once

#include <vector>

#include "splotchcl/vector.h"

namespace splotchcl {

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
