#pragma once

#include <optional>
#include <string>
#include <vector>

#include "splotchcl/frame.h"
#include "splotchcl/vector.h"

namespace splotchcl::view {

// The place in space of what one sees at a place of the picture, in its pixels: the particle in the
// middle, by depth, of the matter whose clouds reach there. Nothing where no cloud does.
std::optional<Vec3> pick_particle(const Frame& frame, double x, double y);

// What the line of sight through a place of a picture meets of one component.
struct ProbedComponent {
  std::string name;
  double column = 0;  // of masses: mass over area, in the snapshot's units
  std::optional<double>
      mean;  // of the color field, weighted by the column; none: no field, no matter
};

struct Probe {
  std::optional<Vec3> position;  // what the pointer would pick
  std::optional<double> distance;
  std::vector<ProbedComponent> components;
};

// At x, y in pixels from the upper left corner.
Probe probe(const Frame& frame, double x, double y);

// Some particles of each component, in turn: x, y, z, x, ...
std::vector<double> some_places(const Frame& frame, std::size_t most);

}  // namespace splotchcl::view
