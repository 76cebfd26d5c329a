#pragma once

#include <functional>
#include <string>
#include <vector>

#include "splotchcl/frame.h"
#include "splotchcl/image.h"
#include "splotchcl/plan.h"
#include "splotchcl/reference.h"

namespace splotchcl::test {

// Whether a case is drawn in one way.
enum class Drawn {
  always,
  in_long_tests,  // takes seconds (long_tests.h); a smaller case is always drawn that way
  never,          // takes minutes
};

// A frame that is hard to draw within its tolerance.
struct HardCase {
  std::string name;  // letters and digits: also the test's name
  std::string why;   // it is hard
  std::function<Frame(LightPlan)> frame;
  std::vector<LightPlan> plans = {LightPlan::emission, LightPlan::proportional, LightPlan::ordered};
  // The picture as it should be: the reference's, or a closed form where that would take minutes.
  std::function<ReferenceImage(const Frame&)> exact = [](const Frame& frame) {
    return reference::render(frame);
  };
  bool dark = false;                   // nothing to see: a black picture is right
  Drawn in_groups = Drawn::always;     // the shape made for GPUs, slow on a processor
  Drawn most_exactly = Drawn::always;  // at tolerance 0
  bool has_bound = true;               // what is certified of it
  Drawn certified_in_order = Drawn::always;
};

// Plans that cases are drawn by, where not all absorb.
inline const std::vector<LightPlan> all_plans = HardCase{}.plans;
inline const std::vector<LightPlan> absorbing_plans = {LightPlan::proportional, LightPlan::ordered};

std::vector<HardCase> light_cases();       // absorption, depth, dynamic range
std::vector<HardCase> source_cases();      // bright sources behind thin or tinted matter
std::vector<HardCase> color_cases();       // palettes
std::vector<HardCase> layer_cases();       // very many layers in one pixel
std::vector<HardCase> order_cases();       // depths, keys, coincident particles
std::vector<HardCase> size_cases();        // widths of clouds, ends of discs
std::vector<HardCase> camera_cases();      // positions, units and fields of view
std::vector<HardCase> picture_cases();     // sizes of pictures, crops
std::vector<HardCase> data_cases();        // numbers of particles, bad values
std::vector<HardCase> promise_cases();     // what the adversary found (tests/adversary)
std::vector<HardCase> wide_angle_cases();  // pictures in all directions, small tolerances

}  // namespace splotchcl::test
