#include "device/drawings.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "certificate/expected_needs.h"
#include "device/frame_checks.h"
#include "parallel/for_blocks.h"
#include "scene/plan/cloud_sample.h"
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

// A rectangle's blocks, those at x1 and y1 not among them.
struct Blocks {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int area() const { return std::max(0, x1 - x0) * std::max(0, y1 - y0); }
};

constexpr Blocks no_blocks = {std::numeric_limits<int>::max(), std::numeric_limits<int>::max(), 0,
                              0};

Blocks together(const Blocks& a, const Blocks& b) {
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

// The smallest rectangles that have all that fail within each column of a rectangle, and each row.
struct Bounds {
  std::vector<Blocks> of_columns, of_rows;
};

Bounds bounds_within(const BlockErrors& blocks, double promise, const Blocks& within) {
  Bounds bounds;
  bounds.of_columns.assign(static_cast<std::size_t>(within.x1 - within.x0), no_blocks);
  bounds.of_rows.assign(static_cast<std::size_t>(within.y1 - within.y0), no_blocks);
  for (int y = within.y0; y < within.y1; ++y) {
    for (int x = within.x0; x < within.x1; ++x) {
      const std::size_t place =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(blocks.columns) +
          static_cast<std::size_t>(x);
      if (static_cast<double>(blocks.errors[place]) <= promise) continue;
      const Blocks block = {x, y, x + 1, y + 1};
      Blocks& column = bounds.of_columns[static_cast<std::size_t>(x - within.x0)];
      Blocks& row = bounds.of_rows[static_cast<std::size_t>(y - within.y0)];
      column = together(column, block);
      row = together(row, block);
    }
  }
  return bounds;
}

using Halves = std::pair<Blocks, Blocks>;

// The two smallest rectangles that a cut between two lines makes.
void cut_between(const std::vector<Blocks>& lines, Halves& best) {
  std::vector<Blocks> behind(lines.size() + 1, no_blocks);
  for (std::size_t i = lines.size(); i-- > 0;)
    behind[i] = together(lines[i], behind[i + 1]);
  Blocks before = no_blocks;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    before = together(before, lines[i]);
    if (before.area() + behind[i + 1].area() < best.first.area() + best.second.area())
      best = {before, behind[i + 1]};
  }
}

struct Part {
  Blocks whole;
  Halves halves;
  int saved() const { return whole.area() - halves.first.area() - halves.second.area(); }
};

// The smallest rectangle that has all that fail within this one.
Part part_of(const BlockErrors& blocks, double promise, const Blocks& within) {
  const Bounds bounds = bounds_within(blocks, promise, within);
  const Blocks whole =
      std::accumulate(bounds.of_rows.begin(), bounds.of_rows.end(), no_blocks, together);
  Part part = {whole, {whole, no_blocks}};
  cut_between(bounds.of_columns, part.halves);
  cut_between(bounds.of_rows, part.halves);
  return part;
}

bool saves_less(const Part& a, const Part& b) {
  return a.saved() < b.saved();
}

}  // namespace

void paste(const DrawnPicture& part, const Rectangle& at, DrawnPicture& whole) {
  constexpr int side = BlockErrors::block_pixels;
  for (int y = 0; y < at.height; ++y) {
    std::copy_n(part.image.at(0, y), 4 * static_cast<std::ptrdiff_t>(at.width),
                whole.image.at(at.x, at.y + y));
  }
  whole.certificate.is_bound &= part.certificate.is_bound;
  BlockErrors& blocks = whole.certificate.blocks;
  const BlockErrors& drawn = part.certificate.blocks;
  for (int y = 0; y < drawn.rows; ++y) {
    for (int x = 0; x < drawn.columns; ++x) {
      blocks
          .errors[static_cast<std::size_t>((at.y / side + y) * blocks.columns + at.x / side + x)] =
          drawn.at(x * side, y * side);
    }
  }
}

ErrorParts worst_within(const std::vector<ErrorParts>& candidates, double error_of_promise) {
  constexpr double rounding = 1e-6;
  ErrorParts worst;
  for (const ErrorParts& parts : candidates) {
    if (parts.sum() <= error_of_promise * (1 + rounding) && parts.sum() > worst.sum())
      worst = parts;
  }
  return worst;
}

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

std::vector<Rectangle> failing_parts(const BlockErrors& blocks, double promise, int width,
                                     int height, double pixels_of_part) {
  constexpr std::size_t most_parts = 64;
  constexpr int side = BlockErrors::block_pixels;
  std::vector<Part> parts = {part_of(blocks, promise, {0, 0, blocks.columns, blocks.rows})};
  if (parts.front().whole.area() == 0) return {};
  while (parts.size() < most_parts) {
    const auto most = std::max_element(parts.begin(), parts.end(), saves_less);
    if (static_cast<double>(most->saved()) * side * side <= pixels_of_part) break;
    const Halves halves = most->halves;
    *most = part_of(blocks, promise, halves.first);
    parts.push_back(part_of(blocks, promise, halves.second));
  }
  std::vector<Rectangle> rectangles;
  for (const Part& part : parts) {
    const Blocks& whole = part.whole;
    rectangles.push_back({whole.x0 * side, whole.y0 * side,
                          std::min(whole.x1 * side, width) - whole.x0 * side,
                          std::min(whole.y1 * side, height) - whole.y0 * side});
  }
  return rectangles;
}

}  // namespace splotchcl
