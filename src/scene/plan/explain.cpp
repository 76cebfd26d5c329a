#include <ostream>
#include <sstream>

#include "splotchcl/plan.h"

namespace splotchcl {
namespace {

void explain_light(const FramePlan& plan, const Frame& frame, std::ostream& out) {
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
      if (plan.slabs > 0) {
        out << "  wide splats in " << plan.slabs
            << " slabs, added up on coarse grids and laid among the narrow ones of their slab; a "
               "GPU draws them in order\n";
      }
      break;
  }
}

void explain_extended(const FramePlan& plan, std::ostream& out) {
  const ToleranceShares& shares = plan.shares;
  out << ": the most exact mode, which promises " << shares.promise << "\n"
      << "  numbers of 45 bits, no coarse grids, no early stop\n"
      << "  ends of the splats " << shares.truncation << ", single precision of the light "
      << shares.arithmetic() << "\n";
}

void explain_shares(const FramePlan& plan, std::ostream& out) {
  const ToleranceShares& shares = plan.shares;
  out << "\n  ends of the splats " << shares.truncation << ", coarse grids " << shares.coarse_grids;
  if (plan.slabs > 0) out << ", order within slabs " << shares.slabs;
  out << ", arithmetic " << shares.arithmetic() << ":\n"
      << "    center values for pixel means " << shares.pixel_mean << ", exp and phi " << shares.phi
      << ", early stop " << shares.early_stop << "\n"
      << "  checked from all splats when it is drawn, and drawn again where that is not enough\n";
}

}  // namespace

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

const char* name(Precision precision) {
  switch (precision) {
    case Precision::fast:
      return "fast";
    case Precision::full:
      return "full";
    case Precision::extended:
      return "extended";
  }
  return "";
}

std::string explain(const FramePlan& plan, const Frame& frame) {
  std::ostringstream out;
  explain_light(plan, frame, out);
  out << "tolerance: " << frame.tolerance << " of white per pixel and channel";
  if (plan.is_extended()) {
    explain_extended(plan, out);
  } else {
    explain_shares(plan, out);
  }
  return out.str();
}

}  // namespace splotchcl
