#include "adversary/classes.h"
#include "adversary/starts.h"

namespace splotchcl::adversary {
namespace {

using test::Random;

ToneCurve any_curve(Random& random) {
  constexpr ToneCurve curves[] = {ToneCurve::linear, ToneCurve::asinh, ToneCurve::filmic};
  return curves[static_cast<int>(random.uniform(0, 3))];
}

// Clouds of some pixels, or where they lie would be known too little at high exposures
// (docs/accuracy.md).
Trial wide_clouds(Random& random) {
  Trial trial = any_base(random);
  trial.min_radius = 3;
  return trial;
}

Trial lifted(Random& random) {
  Trial trial = wide_clouds(random);
  trial.tone = any_curve(random);
  trial.shown.is_on = 1;
  trial.shown.exposure = random.uniform(0, 10);
  trial.shown.white = random.logarithmic(0.1, 10);
  return trial;
}

Trial graded(Random& random) {
  Trial trial = lifted(random);
  trial.shown.exposure = random.uniform(-3, 5);
  trial.shown.saturation = random.uniform(0, 2.5);
  trial.shown.contrast = random.uniform(1, 2.5);
  trial.shown.pivot = random.logarithmic(0.2, 1);
  trial.shown.highlights = random.uniform();
  if (random.uniform() < 0.5) trial.shown.balance = random.logarithmic(1700, 24000);
  return trial;
}

Trial blooming(Random& random) {
  Trial trial = graded(random);
  trial.shown.bloom = random.uniform();
  return trial;
}

Trial found_exposure(Random& random) {
  Trial trial = blooming(random);
  trial.shown.automatic = 1;
  return trial;
}

}  // namespace

std::vector<TrialClass> shown_classes() {
  const std::vector<double> coarse = {1e-3, 1e-2, 1e-4};
  return {
      {"lifted", "exposure lifts errors as it does light", all_lights, coarse, lifted},
      {"graded", "saturation, contrast and the balance of white mix and stretch errors", all_lights,
       coarse, graded},
      {"blooming", "errors of bright pixels glow over dark ones", all_lights, coarse, blooming},
      {"found_exposure", "the drawing that finds it may be too inexact for it", all_lights, coarse,
       found_exposure},
  };
}

}  // namespace splotchcl::adversary
