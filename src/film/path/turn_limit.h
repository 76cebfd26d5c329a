#pragma once

#include <vector>

#include "splotchcl/vector.h"

namespace splotchcl {

// Directions of length 1 that never turn by more than `most_radians` from one to the next: each is
// the mean of those around it, of as few as it takes, so that turns begin earlier and end later.
// Empty where half of all would not do: what turns all along cannot turn more slowly.
std::vector<Vec3> with_slow_turns(const std::vector<Vec3>& directions, double most_radians);

// The largest turn from one direction to the next, in radians.
double largest_turn(const std::vector<Vec3>& directions);

// Between two directions of length 1, in radians.
double angle_between(const Vec3& a, const Vec3& b);

}  // namespace splotchcl
