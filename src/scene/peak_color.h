#pragma once

#include <cstddef>

#include "splotchcl/frame.h"

namespace splotchcl {

// The largest of E and A per unit of a particle's weight, in any channel: a bound over the
// whole palette. The particles' own colours multiply it, except for what peak_own_absorption says.
double peak_color(const DrawnComponent& component);

// E alone, and A alone, which the rule of gray absorption gives E's value without the rule.
double peak_emission(const DrawnComponent& component);
double peak_absorption(const DrawnComponent& component);

// That of an absorption palette of the component's own, 0 without one.
double peak_own_absorption(const DrawnComponent& component);

// The same of single particles, whose own colors are known. Looks into the component.
class PeakColors {
 public:
  explicit PeakColors(const DrawnComponent& component);
  double operator()(std::size_t i) const;

 private:
  const Column& own_colors_;
  double peak_, own_absorption_;
};

}  // namespace splotchcl
