#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "splotchcl/frame.h"

namespace splotchcl {

// A Gaussian of light in space, the same from wherever it is seen: a ray that passes its center in
// the distance d sees light exp(-d^2 / sigma^2).
struct LightSplat {
  std::array<float, 3> place{};  // lengths, relative to an origin
  float sigma = 0;               // lengths, > 0
  std::array<float, 3> light{};  // E w, linear: 1 is a display's white
  // A w, the optical depth through its center, where the order of splats counts; else 0.
  std::array<float, 3> depth{};
};

// Whether the frame's light depends on what lies before what.
bool is_ordered(const Frame& frame);

// Those of all particles of the frame that are not bad, in its order, relative to its look-at
// point. Where matter absorbs in proportion to what it emits, the light alone says it. What the
// camera, its limits and what widens splats make of them is left to who draws.
std::vector<LightSplat> light_splats(const Frame& frame);

// The point that the frame's camera looks at, in lengths.
Vec3 look_at_point(const CameraFrame& camera);

// At most so many splats in place of all. Each of them has the light of those that it stands for,
// their center of light and the second moment of their light, taken round; what they absorb counts
// a tenth as much. Splats that are split
// are those where that loses most of what is shown, by an estimate: the square root of their light,
// as displays show light nearly, times how much of the width squared is distances between members
// and differences of their widths. The same for any number of threads.
std::vector<LightSplat> merge_splats(std::vector<LightSplat> splats, std::size_t most);

}  // namespace splotchcl
