#include "splotchcl/plan.h"

#include <algorithm>
#include <sstream>

namespace splotchcl {
namespace {

using Kind = Absorption::Kind;

bool all_of_kind(const Frame& frame, Kind kind) {
  return std::all_of(frame.components.begin(), frame.components.end(),
                     [kind](const DrawnComponent& c) { return c.absorption.kind == kind; });
}

bool any_own_absorption_colours(const Frame& frame) {
  return std::any_of(frame.components.begin(), frame.components.end(),
                     [](const DrawnComponent& c) { return c.palette.has_own_absorption(); });
}

// A factor on the same palette is one q for the component; two components would need
// their floats compared.
bool one_factor_on_the_emission_palette(const Frame& frame) {
  return frame.components.size() == 1 && all_of_kind(frame, Kind::factor);
}

void choose_light(const Frame& frame, Plan& plan) {
  if (all_of_kind(frame, Kind::none)) {
    plan.light = LightPlan::emission;
    return;
  }
  plan.light = LightPlan::ordered;
  if (any_own_absorption_colours(frame)) return;
  if (all_of_kind(frame, Kind::as_emission)) {
    plan.light = LightPlan::proportional;
  } else if (one_factor_on_the_emission_palette(frame)) {
    const DrawnComponent& component = frame.components.front();
    plan.light = LightPlan::proportional;
    plan.source.fill(component.brightness / component.absorption.factor);
  }
}

}  // namespace

Plan make_plan(const Frame& frame) {
  Plan plan;
  choose_light(frame, plan);
  plan.needs_sort = plan.light == LightPlan::ordered;
  plan.exact = frame.tolerance == 0;
  const double tolerance = plan.exact ? most_exact_tolerance : frame.tolerance;
  if (plan.exact) {
    // Farther discs cost little; single precision's last digits cannot be had back.
    plan.truncation_share = 0.01 * tolerance;
  } else {
    plan.truncation_share = 0.5 * tolerance;
    plan.coarse_share = plan.needs_sort ? 0 : 0.25 * tolerance;
  }
  plan.arithmetic_share = tolerance - plan.truncation_share - plan.coarse_share;
  return plan;
}

const char* name(LightPlan light) {
  switch (light) {
    case LightPlan::emission:
      return "emission";
    case LightPlan::proportional:
      return "proportional";
    case LightPlan::ordered:
      return "ordered";
  }
  return "";
}

std::string explain(const Plan& plan, const Frame& frame) {
  std::ostringstream out;
  out << "plan: " << name(plan.light) << "\n";
  switch (plan.light) {
    case LightPlan::emission:
      out << "  no component absorbs: I = background + sum E X, in any order; no sort\n";
      break;
    case LightPlan::proportional:
      out << "  E = q A for every particle, q = " << plan.source[0]
          << ": I = q + (background - q) exp(-sum A X), in any order; no sort\n";
      break;
    case LightPlan::ordered:
      out << "  emission and absorption differ: sort by "
          << (frame.sort.by == SortOrder::By::depth ? "depth" : frame.sort.field)
          << ", nearer layers over farther ones\n";
      break;
  }
  out << "tolerance: " << frame.tolerance << " of white per pixel and channel\n"
      << "  ends of the splats " << plan.truncation_share << ", coarse grids " << plan.coarse_share
      << ", arithmetic and early stop " << plan.arithmetic_share << "\n";
  return out.str();
}

}  // namespace splotchcl
