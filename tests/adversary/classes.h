#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "adversary/trial.h"
#include "device/scenes.h"

namespace splotchcl::adversary {

// A kind of scene that is dangerous for one reason.
struct TrialClass {
  std::string name;
  std::string why;            // it is dangerous
  std::vector<Light> lights;  // none: starts choose theirs, and all else
  std::vector<double> tolerances;
  std::function<Trial(test::Random&)> start;  // a random one, of any light and tolerance
};
std::vector<TrialClass> cloud_classes();   // where clouds lie, and how many
std::vector<TrialClass> light_classes();   // what they shine and absorb
std::vector<TrialClass> view_classes();    // how they are seen
std::vector<TrialClass> course_classes();  // between two snapshots
std::vector<TrialClass> map_classes();     // as values of a map
std::vector<TrialClass> shown_classes();   // as a display shows them
const std::vector<TrialClass>& all_classes();

// A start with the light, the tolerance and the shape of compositing that this seed chooses: all
// starts of a seed share their kernels.
Trial start_of(const TrialClass& kind, std::uint64_t seed, test::Random& random);

}  // namespace splotchcl::adversary
