// Scenes that the adversary found, or that follow one of its findings: each broke the promise of
// the tolerance once, and holds (docs/contributing.md).
#include <string>
#include <utility>

#include "adversary/trial.h"
#include "adversary/trial_frame.h"
#include "hard_cases/hard_cases.h"

namespace splotchcl::test {
namespace {

using adversary::Trial;

const std::vector<LightPlan> all_plans = HardCase{}.plans;

Trial in_light(Trial trial, LightPlan plan) {
  // A light that the case chooses itself stays.
  if (adversary::plan_of(trial.light) == plan) return trial;
  if (plan == LightPlan::emission) trial.light = adversary::Light::emission;
  if (plan == LightPlan::proportional) trial.light = adversary::Light::proportional;
  if (plan == LightPlan::ordered) trial.light = adversary::Light::ordered;
  return trial;
}

// `text` is what the adversary writes, or less (tests/adversary/trial.h).
HardCase found(const std::string& name, const std::string& why, const std::string& text,
               std::vector<LightPlan> plans = all_plans) {
  HardCase hard;
  hard.name = name;
  hard.why = why;
  hard.plans = std::move(plans);
  const Trial trial = adversary::trial_of(text);
  hard.frame = [trial](LightPlan plan) { return adversary::make_frame(in_light(trial, plan)); };
  hard.exact = [trial](const Frame& frame) {
    return reference::render(adversary::make_merged_frame(in_light(trial, choose_light(frame))));
  };
  hard.most_exactly = Drawn::in_long_tests;
  return hard;
}

}  // namespace

std::vector<HardCase> promise_cases() {
  return {
      found("OwnColorsOfACrowd", "the light of a crowd is in its particles' own colours",
            "own_colors 1 group point copies 300 sigma 2.2 peak 2 color 300"),
      found("OwnColorsOfCrowds", "the same, some clouds' own colours being 4200",
            "own_colors 1 group point places 10 copies 400 y -5.6 sigma 2 peak 4 color 4200"),
      found("OwnColorsOfStars", "sharp stars whose palette is faint",
            "turned 1 projection perspective tolerance 1e-4 own_colors 1 field_of_view 10 group "
            "scatter places 20 y -1.79178 sigma 0.3 peak 1e4 color 1e4"),
      found("CrowdBetweenTheSamplesOfAFile",
            "a crowd of 2000 among 2e5 particles that a sample of every 13th never meets",
            "filler 198000 period 13 offset 4 group point copies 2000 sigma 5.2"),
      found("LargeCrowdBetweenTheSamples", "the same of 6000",
            "filler 194000 period 13 offset 5 group point copies 6000 y -9 sigma 5"),
      found("CrowdFarBesideThePicture",
            "a crowd more than four sigma outside, so bright that it is seen; a search that ends "
            "nearer does not",
            "group point places 4 copies 340 x 82.3954 sigma 11.0476 width_range 1.017 peak 80000"),
      found("StarsOfAFisheyeAt1e_5", "places are arcs in single precision",
            "projection fisheye tolerance 1e-5 field_of_view 42 turned 1 group scatter places 30 "
            "sigma 1 peak 20000 depth 50",
            {LightPlan::emission}),
      found("StarsOfAPanoramaAt1e_5", "the same of longitudes and latitudes",
            "projection equirectangular height 32 tolerance 1e-5 turned 1 group scatter places 30 "
            "sigma 1 peak 20000 depth 50",
            {LightPlan::emission}),
      found("StarsOfACubeFaceAt1e_5", "the same of quotients whose widths grow towards the corners",
            "projection cube width 48 tolerance 1e-5 turned 1 group scatter places 30 sigma 1 peak "
            "20000 depth 50",
            {LightPlan::emission}),
  };
}

}  // namespace splotchcl::test
