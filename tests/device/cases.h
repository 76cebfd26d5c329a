#pragma once

#include "device/scenes.h"
#include "splotchcl/plan.h"
#include "splotchcl/renderer.h"
#include "testing.h"

namespace splotchcl::test {

// What tests of several plans and shapes are repeated for.
inline constexpr LightPlan all_plans[] = {LightPlan::emission, LightPlan::proportional,
                                          LightPlan::ordered};

// Of components whose frame needs this plan.
inline Absorption absorption_for(LightPlan plan) {
  if (plan == LightPlan::emission) return {Absorption::Kind::none, 0};
  if (plan == LightPlan::ordered) return {Absorption::Kind::gray, 0.2};
  return {};
}

inline Frame clouds_for(LightPlan plan, const CloudSetup& setup = {}) {
  DrawnComponent component = random_clouds(setup);
  component.absorption = absorption_for(plan);
  return frame_of(setup.width, setup.height, {component});
}

using PlanAndShape = std::tuple<LightPlan, CompositeShape>;

inline auto both_shapes() {
  return testing::Values(CompositeShape::rows, CompositeShape::groups);
}
inline auto each_plan_and_shape() {
  return testing::Combine(testing::ValuesIn(all_plans), both_shapes());
}

inline std::string name_of_case(const testing::TestParamInfo<PlanAndShape>& info) {
  return std::string(name(std::get<0>(info.param))) +
         (std::get<1>(info.param) == CompositeShape::rows ? "_rows" : "_groups");
}

}  // namespace splotchcl::test
