#include "splotchcl/plan.h"

#include <algorithm>
#include <sstream>

#include "scene/crowding.h"
#include "scene/sharpness.h"

namespace splotchcl {
namespace {

using Kind = Absorption::Kind;

bool all_of_kind(const Frame& frame, Kind kind) {
  return std::all_of(frame.components.begin(), frame.components.end(),
                     [kind](const DrawnComponent& c) { return c.absorption.kind == kind; });
}

bool any_own_absorption_colors(const Frame& frame) {
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
  if (any_own_absorption_colors(frame)) return;
  if (all_of_kind(frame, Kind::as_emission)) {
    plan.light = LightPlan::proportional;
  } else if (one_factor_on_the_emission_palette(frame)) {
    const DrawnComponent& component = frame.components.front();
    plan.light = LightPlan::proportional;
    plan.source.fill(component.brightness / component.absorption.factor);
  }
}

// The one place that spends the tolerance.
void share_out(double tolerance, Plan& plan) {
  plan.exact = tolerance == 0;
  if (plan.exact) {
    // Farther discs cost little; single precision's last digits cannot be had back.
    plan.truncation_share = 0.01 * most_exact_tolerance;
    plan.arithmetic_share = most_exact_tolerance - plan.truncation_share;
    plan.pixel_mean_share = 0.5 * plan.arithmetic_share;
    plan.phi_share = plan.arithmetic_share - plan.pixel_mean_share;
    return;
  }
  const bool ordered = plan.light == LightPlan::ordered;
  plan.truncation_share = 0.5 * tolerance;
  plan.coarse_share = ordered ? 0 : 0.25 * tolerance;
  plan.arithmetic_share = tolerance - plan.truncation_share - plan.coarse_share;
  plan.stop_share = ordered ? 0.2 * plan.arithmetic_share : 0;
  plan.phi_share = (ordered ? 0.2 : 0.25) * plan.arithmetic_share;
  plan.pixel_mean_share = plan.arithmetic_share - plan.phi_share - plan.stop_share;
}

}  // namespace

Plan make_plan(const Frame& frame) {
  Plan plan;
  choose_light(frame, plan);
  plan.needs_sort = plan.light == LightPlan::ordered;
  // Wide angles have single precision only, and at tolerance 0 do what that can.
  const bool is_bounded = frame.tolerance > 0 || !is_wide_angle(frame.projection);
  share_out(is_bounded ? frame.tolerance : most_exact_tolerance, plan);
  return plan;
}

namespace {

// Roundings have either sign and few clouds are as sharp as the sharpest: errors were an eighth
// of what the sharpest could do (docs/accuracy.md).
bool places_exceed_tolerance(const Frame& frame) {
  constexpr double largest = 3e-4, part_of_sharpest = 0.15;
  if (frame.tolerance >= largest || is_wide_angle(frame.projection)) return false;
  const double place_error = 0x1p-23 * std::max(frame.crop.width, frame.crop.height);
  return part_of_sharpest * 0.86 * place_error * find_sharpness(frame) > frame.tolerance;
}

}  // namespace

Plan make_plan_from_particles(const Frame& frame) {
  Plan plan = make_plan(frame);
  if (plan.exact) return plan;  // its bound holds for any particles
  plan.needs_exact_places = places_exceed_tolerance(frame);
  if (!plan.needs_exact_places) plan.crowd = find_crowd(frame);
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

namespace {

void explain_shares(const Plan& plan, double tolerance, std::ostream& out) {
  out << "tolerance: " << tolerance << " of white per pixel and channel";
  if (plan.exact) {
    out << ": the most exact mode, which promises " << most_exact_tolerance << "\n"
        << "  numbers of 45 bits, no coarse grids, no early stop\n"
        << "  ends of the splats " << plan.truncation_share << ", single precision of the light "
        << plan.arithmetic_share << "\n";
    return;
  }
  out << "\n  ends of the splats " << plan.truncation_share << ", coarse grids "
      << plan.coarse_share << ", arithmetic " << plan.arithmetic_share << ":\n"
      << "    centre values for pixel means " << plan.pixel_mean_share << ", exp and phi "
      << plan.phi_share << ", early stop " << plan.stop_share << "\n";
  if (plan.needs_exact_places) {
    out << "  clouds are too sharp for places in single precision: drawn as with tolerance 0\n";
  }
  if (plan.crowd.light > 0) {
    out << "  clouds of light " << plan.crowd.light << " lie upon one another: those of sigma "
        << plan.crowd.narrowest_sigma << " to " << plan.crowd.widest_sigma
        << " pixels are drawn farther and finer\n";
  }
}

}  // namespace

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
  explain_shares(plan, frame.tolerance, out);
  return out.str();
}

}  // namespace splotchcl
