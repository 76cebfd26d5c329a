#include "device/next_drawing.h"

#include <algorithm>

namespace splotchcl {

FramePlan next_plan(const Frame& frame, const FramePlan& plan, const Certificate& certificate,
                    std::size_t drawings) {
  // What converges does so in a step or two.
  constexpr std::size_t most_drawings = 4;
  if (drawings >= most_drawings || certificate.needs_extended) return extend_plan(frame, plan);
  if (!plan.certify) return refine_plan(frame, plan, certificate.needs);
  // Bounds fall more slowly than what is shared out: by no less than 4 at a time.
  return tighten_plan(frame, plan, std::clamp(2 * certificate.error_of_promise, 4.0, 1000.0));
}

double pixels_of_part(const Frame& frame, const FramePlan& plan, const DrawCounts& counts) {
  // Nanoseconds of two cores (docs/dev/tuning.md, "Slabs").
  constexpr double start = 1e6, pixel = 50, pixel_in_order = 1000;
  constexpr double part_in_order = 10, part_of_sum = 20;  // for each particle
  constexpr double project = 7, sort = 5, entry_in_order = 50, entry_of_sum = 20;
  const auto particles = static_cast<double>(particle_count(frame));
  const double of_part = start + (plan.needs_sort() ? part_in_order : part_of_sum) * particles;
  if (plan.slabs > 0) return of_part / pixel_in_order;
  const auto entries = static_cast<double>(counts.tile_entries);
  const double pixels = static_cast<double>(frame.crop.width) * frame.crop.height;
  const double whole = start + pixel * pixels +
                       (plan.needs_sort() ? (project + sort) * particles + entry_in_order * entries
                                          : project * particles + entry_of_sum * entries);
  return pixels * of_part / whole;
}

SplatNeeds with_all_octaves(SplatNeeds needs) {
  constexpr double less = 1.5;
  double farthest = 0;
  for (const WidthNeed& need : needs.widths)
    farthest = std::max(farthest, need.farther);
  for (WidthNeed& need : needs.widths)
    need.farther = std::max(need.farther, farthest - less);
  return needs;
}

}  // namespace splotchcl
