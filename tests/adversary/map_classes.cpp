#include "adversary/classes.h"
#include "adversary/starts.h"

namespace splotchcl::adversary {
namespace {

using test::Random;

// Maps show one kind of light; what else a base chooses of it says nothing.
Trial map_of(MapKind kind, Random& random) {
  Trial trial = any_base(random);
  trial.background = 0;
  trial.map = kind;
  trial.map_floor = random.logarithmic(1e-8, 1e-2);
  if (random.uniform() < 0.7) trial.value_decades = random.logarithmic(0.3, 40);
  for (CloudGroup& group : trial.groups) {
    group.peak = random.logarithmic(1e-4, 1e6);
    group.hue = random.uniform();
  }
  CloudGroup another = trial.groups.front();
  another.x = random.uniform(-20, 20);
  another.hue = random.uniform();
  another.sigma = random.logarithmic(0.3, 100);
  trial.groups.push_back(another);
  return trial;
}

std::function<Trial(Random&)> maps_of(MapKind kind) {
  return [kind](Random& random) { return map_of(kind, random); };
}

Trial slice(Random& random) {
  Trial trial = map_of(random.uniform() < 0.5 ? MapKind::column : MapKind::mean, random);
  trial.slice = 1;
  return trial;
}

Trial of_both_signs(Random& random) {
  Trial trial = map_of(random.uniform() < 0.5 ? MapKind::integral : MapKind::mean, random);
  trial.signs = 1;
  return trial;
}

const std::vector<Light> one_light = {Light::emission};
const std::vector<double> of_maps = {1e-3, 1e-2, 1e-4, 0};

}  // namespace

std::vector<TrialClass> map_classes() {
  return {
      {"map_column", "dark pixels count by a floor", one_light, of_maps, maps_of(MapKind::column)},
      {"map_mean", "quotients of sums whose values have any range", one_light, of_maps,
       maps_of(MapKind::mean)},
      {"map_dispersion", "differences of means of squares", one_light, of_maps,
       maps_of(MapKind::dispersion)},
      {"map_integral", "values of any range are summed", one_light, of_maps,
       maps_of(MapKind::integral)},
      {"map_slice", "a plane cuts through kernels", one_light, of_maps, slice},
      {"map_signs", "what lies above and below 0 is summed apart", one_light, of_maps,
       of_both_signs},
  };
}

}  // namespace splotchcl::adversary
