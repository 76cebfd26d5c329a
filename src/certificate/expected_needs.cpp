#include "certificate/expected_needs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "certificate/cells.h"
#include "certificate/octave_errors.h"
#include "scene/plan/light_structure.h"
#include "scene/plan/splat_limits.h"
#include "splotchcl/frame_check.h"

namespace splotchcl {
namespace {

// In pixels of the picture, widened.
double drawn_sigma(const SampledCloud& cloud, const FramePlan& plan) {
  return std::sqrt(cloud.sigma * cloud.sigma + static_cast<double>(plan.splats.widening));
}

// Of a sigma in pixels of the picture (PeakCells::octave).
int width_octave(double sigma) {
  return sigma < 1 ? 0 : std::min(std::ilogb(sigma) + 1, width_octaves - 1);
}

// More than is found: the check asks for one and a half times as much, and finds what the sample
// does not show.
constexpr double margin_of_all = 2.5, margin_of_sample = 4;

// Where splats are drawn: on the picture's own grid, or on the others of a level.
struct GridsOfSplats {
  int level = 0;
  bool are_picture = true;

  bool operator==(const GridsOfSplats& other) const {
    return level == other.level && are_picture == other.are_picture;
  }
};

// The sampled splats of one octave of widths on the grid that they are drawn on, in cells as those
// of the check (docs/dev/accuracy.md, "Checked after drawing").
struct OctaveSample {
  OctaveSample(int octave_of_widths, GridsOfSplats drawn_on)
      : octave(octave_of_widths),
        on(drawn_on),
        cells(on.level + peak_cell_shift(octave - on.level)) {}

  int octave;
  GridsOfSplats on;
  CrowdCells cells;
};

GridsOfSplats grids_of(const SampledCloud& cloud, double sigma, const FramePlan& plan) {
  const GridPyramid& pyramid = plan.pyramid;
  const double ratio =
      std::ldexp(pyramid.over_least_width(sigma, cloud.light), -pyramid.first_level);
  if (ratio < 1) return {};
  const int coarsest = static_cast<int>(pyramid.level_grids.size()) - 1;
  return {std::min(std::ilogb(ratio) + pyramid.first_level, coarsest), false};
}

// Octaves on the picture's own grid, and on coarse ones, the narrowest first.
std::vector<OctaveSample> collect(const std::vector<SampledCloud>& clouds, const FramePlan& plan) {
  std::array<std::vector<OctaveSample>, width_octaves> octaves;
  for (const SampledCloud& cloud : clouds) {
    const double sigma = drawn_sigma(cloud, plan);
    const int octave = width_octave(sigma);
    const GridsOfSplats on = grids_of(cloud, sigma, plan);
    std::vector<OctaveSample>& samples = octaves[static_cast<std::size_t>(octave)];
    auto at = std::find_if(samples.begin(), samples.end(),
                           [&](const OctaveSample& one) { return one.on == on; });
    if (at == samples.end()) at = samples.insert(at, OctaveSample(octave, on));
    const auto bright = static_cast<double>(plan.splats.bright_peak);
    const double light = on.are_picture ? std::min(cloud.light, bright) : cloud.light;
    at->cells.add(cloud.x, cloud.y, cloud.weight * light);
  }
  std::vector<OctaveSample> all;
  for (std::vector<OctaveSample>& samples : octaves)
    std::move(samples.begin(), samples.end(), std::back_inserter(all));
  return all;
}

// What splats of one octave on one grid do where most lie upon one another.
struct Crowd {
  int octave = 0;
  GridsOfSplats on;
  double light = 0, error = 0;  // over what is promised
  double light_of_means = 0;
};

Crowd crowd_of(OctaveSample& sample, bool is_sample, const Frame& frame, const FramePlan& plan) {
  PeakCells nothing;
  nothing.octave = sample.octave;
  nothing.level = sample.on.level;
  nothing.is_beside_picture = sample.on.level == 0 && !sample.on.are_picture;
  nothing.peaks = nothing.endings = {1, 1, 1, {0}};
  const OctaveErrors errors(nothing, frame, plan);
  const double light = sample.cells.crowded_light(is_sample);
  const double error = std::min(errors.peak_error() * light, errors.part_of_itself(light));
  return {sample.octave, sample.on, light, error / plan.shares.promise, errors.light_of_means()};
}

std::vector<Crowd> crowds_of(const std::vector<SampledCloud>& clouds, bool is_sample,
                             const Frame& frame, const FramePlan& plan, const BlockLoop& loop) {
  std::vector<OctaveSample> samples = collect(clouds, plan);
  std::vector<Crowd> crowds(samples.size());
  loop(samples.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      crowds[i] = crowd_of(samples[i], is_sample, frame, plan);
  });
  return crowds;
}

double most_error(const std::vector<Crowd>& crowds) {
  double most = 0;
  for (const Crowd& crowd : crowds)
    most = std::max(most, crowd.error);
  return most;
}

// Sources without a brightest, which shine through what absorbs, amplify errors by how bright they
// are there.
bool can_expect_crowds(const Frame& frame, const FramePlan& plan) {
  return !plan.needs_sort() || std::isfinite(brightest_source(frame));
}

// What wider splats of light without absorption need is guessed from how bright it is
// (make_plan.cpp).
void keep_narrow_ones(SplatNeeds& needs) {
  constexpr std::size_t guessed = 2;
  std::fill(needs.widths.begin() + guessed, needs.widths.end(), WidthNeed());
  needs.grid_light = 1;
}

// `error` is the most that any of them do.
void add_needs_of_crowds(const std::vector<Crowd>& crowds, double error, double times,
                         const FramePlan& plan, SplatNeeds& needs) {
  double on_grids = 0;
  for (const Crowd& crowd : crowds) {
    if (!crowd.on.are_picture) on_grids = std::max(on_grids, crowd.light);
  }
  needs.grid_light = std::max(1.0, times * on_grids);
  for (const Crowd& crowd : crowds) {
    const auto octave = static_cast<std::size_t>(crowd.octave);
    WidthNeed& need = needs.widths[octave];
    if (crowd.light > 0) need.farther = std::log(times * error);
    // Beside the picture's own grid no blurred grid may be good enough: they are drawn on it then.
    if (crowd.on.level > 0 || crowd.error <= 0) continue;
    const double had = std::max(1.0, plan.needs.widths[octave].light);
    const double in_proportion = std::min(times * error * had, crowd.light_of_means);
    need.light = std::max({need.light, times * crowd.light, in_proportion});
  }
}

}  // namespace

bool can_be_expected(const FramePlan& plan) {
  const bool has_errors = plan.has_errors_of_splats || plan.needs_sort();
  return has_errors && !plan.is_extended() && !plan.certify && !plan.has_ellipses;
}

std::optional<SplatNeeds> expected_needs(const std::vector<SampledCloud>& clouds,
                                         const Frame& frame, const FramePlan& plan,
                                         const BlockLoop& loop) {
  if (!plan.has_errors_of_splats || !can_expect_crowds(frame, plan)) return std::nullopt;
  const bool is_sample = !clouds.empty() && clouds.front().weight > 1;
  const std::vector<Crowd> crowds = crowds_of(clouds, is_sample, frame, plan, loop);
  const double error = most_error(crowds), times = is_sample ? margin_of_sample : margin_of_all;
  // As much may be left to the check.
  if (error <= 1) return std::nullopt;
  SplatNeeds needs;
  add_needs_of_crowds(crowds, error, times, plan, needs);
  if (plan.light == LightPlan::emission) keep_narrow_ones(needs);
  return needs;
}

}  // namespace splotchcl
