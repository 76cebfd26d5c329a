#pragma once

#include <functional>
#include <vector>

#include "adversary/trial.h"
#include "snapshot/memory_snapshot.h"
#include "splotchcl/scene.h"

namespace splotchcl::adversary {

// A trial as a map: a pixel is a length of 1, and the middle lies at 0.
Scene map_scene_of(const Trial& trial);
test::MemorySnapshot map_snapshot_of(const Trial& trial);

// What lies in one pixel of a map, in double precision, by no code of the program's: sums of
// weights, and of weights times what lies above 0 and below it. Some of both is from where kernels
// end (docs/maps.md), farther than 6 sigma, and may be missing.
struct PixelOfMap {
  double weight = 0, above = 0, below = 0;
  double open_weight = 0, open_both = 0;
  double both() const { return above + below; }
};
using ExactMap = std::vector<PixelOfMap>;

// With something of the particles' values.
using OfValue = std::function<double(double)>;
ExactMap exact_map(const Trial& trial, const OfValue& of_value);

// What the brightest of all particles gives a pixel, with its weight times that.
double brightest_particle(const Trial& trial, const OfValue& of_value);

}  // namespace splotchcl::adversary
