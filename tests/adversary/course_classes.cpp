#include "adversary/classes.h"
#include "adversary/starts.h"

namespace splotchcl::adversary {
namespace {

using test::Random;

// Devices find places and widths by themselves.
Trial between_snapshots(Random& random) {
  Trial trial = any_base(random);
  trial.between = random.uniform(0.02, 0.98);
  trial.motion = random.logarithmic(0.1, 3000);
  if (random.uniform() < 0.5) trial.projection = Projection::perspective;
  return trial;
}

Trial across_faces_of_a_box(Random& random) {
  Trial trial = between_snapshots(random);
  trial.box = random.logarithmic(100, 3000);
  return trial;
}

}  // namespace

std::vector<TrialClass> course_classes() {
  return {
      {"between_snapshots", "places and widths are found as they are drawn", all_lights, usual,
       between_snapshots},
      {"across_faces_of_a_box", "the same where paths are put back into a box", all_lights, usual,
       across_faces_of_a_box},
  };
}

}  // namespace splotchcl::adversary
