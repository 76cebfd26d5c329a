#pragma once

#include <boost/qvm/quat.hpp>
#include <vector>

#include "splotchcl/vector.h"

namespace splotchcl {

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

}  // namespace splotchcl
