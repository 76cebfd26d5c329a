#pragma once

#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "splotchcl/plan.h"
#include "splotchcl/renderer.h"

namespace splotchcl::test {

// What tests of several plans and shapes are repeated for.
inline constexpr LightPlan all_plans[] = {LightPlan::emission, LightPlan::proportional,
                                          LightPlan::ordered};

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
