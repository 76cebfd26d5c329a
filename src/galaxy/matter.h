#pragma once

#include <cstddef>

#include "splotchcl/turning_galaxy.h"
#include "splotchcl/vector.h"

namespace splotchcl {

// Gadget's types for a galaxy's matter.
constexpr int gas_type = 0, disk_type = 2, bulge_type = 3, cluster_type = 4, dust_type = 5;

// What is part of the pattern of arms.
constexpr bool is_disk_type(int type) {
  return type == gas_type || type == disk_type || type == dust_type;
}

// The speed about the axis that a velocity shows, in radians per Myr.
double shown_angular_speed(const OrbitState& state, const Vec3& axis);

// The i-th vector of values in which the three of a vector lie side by side.
template <class Values>
Vec3 vector_at(const Values& values, std::size_t i) {
  return {{static_cast<double>(values[3 * i]), static_cast<double>(values[3 * i + 1]),
           static_cast<double>(values[3 * i + 2])}};
}

}  // namespace splotchcl
