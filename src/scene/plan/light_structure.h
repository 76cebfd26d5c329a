#pragma once

#include <array>

#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// What the scene says of its light, before any number of a particle is looked at.
struct LightStructure {
  LightPlan light = LightPlan::ordered;
  std::array<double, 3> source = {1, 1, 1};  // E / A, for proportional
};
LightStructure find_light_structure(const Frame& frame);

bool has_own_colors(const DrawnComponent& component);

// The brightest light behind everything, in any channel.
double brightest_background(const Frame& frame);
// Largest E / A of any component: the most that a thick layer can shine. Infinite where
// something does not absorb.
double brightest_source(const Frame& frame);
double brightest_source(const DrawnComponent& component);

}  // namespace splotchcl
