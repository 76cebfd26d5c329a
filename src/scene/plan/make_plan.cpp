#include <algorithm>

#include "scene/plan/crowding.h"
#include "scene/plan/error_budget.h"
#include "scene/plan/grid_pyramid.h"
#include "scene/plan/light_structure.h"
#include "scene/plan/splat_limits.h"
#include "splotchcl/plan.h"

namespace splotchcl {
namespace {

// Copies of a splat on either side of an equirectangular picture (kernels/project).
constexpr int splats_with_copies = 7;

}  // namespace

LightPlan choose_light(const Frame& frame) {
  return find_light_structure(frame).light;
}

FramePlan make_plan(const Frame& frame, const PlanOptions& options) {
  FramePlan plan;
  const LightStructure structure = find_light_structure(frame);
  plan.light = structure.light;
  plan.source = structure.source;
  plan.has_vector_colors =
      std::any_of(frame.components.begin(), frame.components.end(), has_own_colors);
  plan.has_ellipses = frame.projection == Projection::equirectangular;
  if (plan.has_ellipses) plan.splats_per_particle = splats_with_copies;

  const ErrorBudget budget = make_error_budget(frame, plan.light, options);
  plan.precision = budget.precision;
  plan.uses_device_erf = budget.uses_device_erf;
  plan.has_sharp_clouds = budget.has_sharp_clouds;
  plan.shares = budget.shares;

  // The extended bound holds for any particles.
  if (!plan.is_extended()) plan.crowd = find_crowd(frame);
  const double background = brightest_background(frame);
  const double source = brightest_source(frame);
  const double response =
      is_wide_crowd(plan.crowd) ? 1 : response_to_splats(plan.light, source, background);
  plan.splats = choose_splat_limits(frame.kernel, plan.shares, plan.crowd, response);
  // Coarse grids are for round splats.
  const bool has_coarse_grids = plan.shares.coarse_grids > 0 && !plan.has_ellipses;
  plan.pyramid = has_coarse_grids ? make_pyramid(frame.crop, frame.kernel, plan.splats.mean_sigma,
                                                 plan.shares.coarse_grids / response)
                                  : make_single_grid(frame.crop);
  plan.layers = choose_layer_limits(plan.shares, plan.light, std::max(background, source));
  return plan;
}

}  // namespace splotchcl
