// The cases of promise.rows.
#include "adversary/trial.h"
#include "adversary/trial_frame.h"
#include "hard_cases/hard_cases.h"
#include "testing.h"
#include "text_rows.h"

namespace splotchcl::test {
namespace {

using adversary::Trial;

Trial in_light(Trial trial, LightPlan plan) {
  // A light that the case chooses itself stays.
  if (adversary::plan_of(trial.light) == plan) return trial;
  if (plan == LightPlan::emission) trial.light = adversary::Light::emission;
  if (plan == LightPlan::proportional) trial.light = adversary::Light::proportional;
  if (plan == LightPlan::ordered) trial.light = adversary::Light::ordered;
  return trial;
}

// Plans by their names, if there are any, and what else is said of a case.
void set(const std::string& words, HardCase& hard) {
  std::vector<LightPlan> plans;
  std::istringstream stream(words);
  for (std::string word; stream >> word;) {
    const auto plan = std::find_if(all_plans.begin(), all_plans.end(),
                                   [&](LightPlan light) { return word == name(light); });
    if (plan != all_plans.end()) {
      plans.push_back(*plan);
    } else if (word == "dark") {
      hard.dark = true;
    } else if (word == "without_bound") {
      hard.has_bound = false;
    } else if (word == "slow_in_groups") {
      hard.in_groups = Drawn::in_long_tests;
    } else {
      throw std::runtime_error(hard.name + ": unknown word " + word);
    }
  }
  if (!plans.empty()) hard.plans = std::move(plans);
}

HardCase case_of(const TextRow& row) {
  HardCase hard;
  hard.name = row.name;
  hard.why = row.expected.at(0);
  if (row.expected.size() > 1) set(row.expected[1], hard);
  const Trial trial = adversary::trial_of(row.texts.at(0));
  hard.frame = [trial](LightPlan plan) { return adversary::make_frame(in_light(trial, plan)); };
  hard.exact = [trial](const Frame& frame) {
    return reference::render(adversary::make_merged_frame(in_light(trial, choose_light(frame))));
  };
  // Wide angles have single precision only.
  hard.most_exactly = is_wide_angle(trial.projection) ? Drawn::never : Drawn::in_long_tests;
  return hard;
}

}  // namespace

std::vector<HardCase> promise_cases() {
  std::vector<HardCase> cases;
  for (const TextRow& row :
       read_text_rows(source_folder() / "tests" / "hard_cases" / "promise.rows"))
    cases.push_back(case_of(row));
  return cases;
}

}  // namespace splotchcl::test
