// The plan that a frame is first drawn by.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "certificate/expected_needs.h"
#include "device/frame_checks.h"
#include "parallel/for_blocks.h"
#include "scene/plan/cloud_sample.h"
#include "scene/plan/tried_parts.h"
#include "splotchcl/plan.h"
#include "splotchcl/renderer.h"

namespace splotchcl {
namespace {

void all_cores(std::size_t count, std::size_t block_size,
               const std::function<void(std::size_t, std::size_t)>& work) {
  for_blocks(count, block_size, work);
}

// Of the light of a frame (LightMap): beyond this, what slabs change by their order breaks the
// promise nearly everywhere.
constexpr double too_bright_for_slabs = 0.7;

// From which light on parts of a frame are tried. Of many particles it takes a twentieth of a dim
// frame, of which few have to be drawn again; of few it takes no longer than a part of them.
double least_tried(const Frame& frame) {
  constexpr std::uint64_t many = 1u << 20;
  return particle_count(frame) > many ? 4 : 0.2;
}

}  // namespace

FramePlan Renderer::first_plan(const Frame& frame, const PlanOptions& options, bool on_all_cores) {
  check_frame(frame);
  FramePlan plan = make_plan(frame, options);
  if (!can_be_expected(plan)) return plan;
  const BlockLoop loop = on_all_cores ? all_cores : one_after_the_other;
  const std::vector<SampledCloud> clouds = sample_clouds(frame, loop);
  const LightMap light(clouds, frame);
  const bool may_choose = plan.slabs > 0 && options.slabs < 0;
  if (may_choose && light.of_bright_quarter() > too_bright_for_slabs)
    plan = in_order_plan(frame, plan);
  const std::optional<SplatNeeds> needs = expected_needs(clouds, frame, plan, loop);
  if (needs) plan = refine_plan(frame, plan, *needs);
  if (light.brightest() >= least_tried(frame)) plan.tried_parts = light.telling_parts(plan.light);
  return plan;
}

}  // namespace splotchcl
