#pragma once

#include <array>
#include <string>

#include "splotchcl/frame.h"

namespace splotchcl {

// What a frame costs follows from the structure of its light, never from comparing
// floats:
//   emission      nothing absorbs:  I = background + sum E X
//   proportional  E = q A for all:  I = q + (background - q) exp(-sum A X)
//   ordered       anything else:    sort, then layers nearer over farther
enum class LightPlan { emission, proportional, ordered };

// What tolerance 0 promises instead, of max(1, |oracle|) (docs/accuracy.md).
constexpr double most_exact_tolerance = 1e-6;

// Clouds that lie upon one another in one place of the picture (docs/accuracy.md).
struct Crowd {
  double light = 0;  // or depth, of all of them; 0: there is no crowd
  // Only clouds of such widths do: sigma in pixels.
  double narrowest_sigma = 0, widest_sigma = 0;
};

struct Plan {
  LightPlan light = LightPlan::emission;
  std::array<double, 3> source = {1, 1, 1};  // q, for proportional
  bool needs_sort = false;
  bool exact = false;  // tolerance 0: numbers of 45 bits, no coarse grids, no early stop

  // How the tolerance (most_exact_tolerance for 0) is shared out (docs/accuracy.md). They
  // add up to it.
  double truncation_share = 0;  // of a splat's light left out by ending its disc
  double coarse_share = 0;      // coarse grids (sums only)
  double arithmetic_share = 0;  // of which:
  double pixel_mean_share = 0;  // centre values in place of means over pixels
  double phi_share = 0;         // exp and (1 - exp(-y)) / y
  double stop_share = 0;        // what an early stop leaves out (ordered only)

  Crowd crowd;  // from the particles: make_plan finds none
  // Clouds are so sharp for a small tolerance that their places in single precision would not
  // hold it: the frame is drawn as with tolerance 0. Also from the particles.
  bool needs_exact_places = false;
};

Plan make_plan(const Frame& frame);

// The same with what the positions and widths of the particles tell: a millisecond or two.
Plan make_plan_from_particles(const Frame& frame);

// Lines for --explain: the plan, why it is exact, and how the tolerance is spent.
std::string explain(const Plan& plan, const Frame& frame);

const char* name(LightPlan light);

}  // namespace splotchcl
