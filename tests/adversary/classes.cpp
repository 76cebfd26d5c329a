#include "adversary/classes.h"

#include <iterator>

namespace splotchcl::adversary {
namespace {

std::vector<TrialClass> joined(std::vector<std::vector<TrialClass>> kinds) {
  std::vector<TrialClass> all;
  for (std::vector<TrialClass>& kind : kinds)
    all.insert(all.end(), std::make_move_iterator(kind.begin()),
               std::make_move_iterator(kind.end()));
  return all;
}

}  // namespace

const std::vector<TrialClass>& all_classes() {
  static const std::vector<TrialClass> classes =
      joined({cloud_classes(), light_classes(), view_classes(), course_classes(), map_classes(),
              shown_classes()});
  return classes;
}

Trial start_of(const TrialClass& kind, std::uint64_t seed, test::Random& random) {
  Trial trial = kind.start(random);
  trial.kind = kind.name;
  if (kind.lights.empty()) return trial;
  trial.light = kind.lights[seed % kind.lights.size()];
  trial.tolerance = kind.tolerances[seed / kind.lights.size() % kind.tolerances.size()];
  trial.turned = seed % 3 != 1 ? 1 : 0;
  if (seed % 5 == 4) trial.shape = CompositeShape::groups;
  return trial;
}

}  // namespace splotchcl::adversary
