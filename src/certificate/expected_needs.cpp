#include "certificate/expected_needs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include "certificate/expected_ends.h"
#include "certificate/octave_errors.h"
#include "certificate/peak_cells.h"
#include "certificate/width_octave.h"
#include "parallel/for_blocks.h"
#include "scene/plan/cloud_sample.h"
#include "scene/plan/light_structure.h"

namespace splotchcl {
namespace {

// A square of cells of fewer sampled particles tells nothing of how many there are.
constexpr double fewest = 6;
// What the light of n sampled particles may be too large by, in parts of itself times root n.
constexpr double deviations = 2;
// More than is found: the check asks for one and a half times as much, and finds what the sample
// does not show.
constexpr double margin_of_all = 2.5, margin_of_sample = 4;

struct Sampled {
  double peak = 0, count = 0;

  Sampled& operator+=(const Sampled& other) {
    peak += other.peak;
    count += other.count;
    return *this;
  }
};

// Where splats are drawn: on the picture's own grid, or on the others of a level.
struct GridsOfSplats {
  int level = 0;
  bool are_picture = true;

  bool operator==(const GridsOfSplats& other) const {
    return level == other.level && are_picture == other.are_picture;
  }
};

// The sampled splats of one octave of widths on the grid that they are drawn on, in cells as those
// of the check (docs/accuracy.md, "Checked after drawing").
class OctaveSample {
 public:
  OctaveSample(int octave, GridsOfSplats on)
      : on_(on), shift_(on.level + peak_cell_shift(octave - on.level)) {}

  GridsOfSplats on() const { return on_; }

  void add(const SampledCloud& cloud, double most_peak) {
    Sampled& cell = cells_[key(cell_of(cloud.x), cell_of(cloud.y))];
    cell += {cloud.weight * std::min(cloud.light, most_peak), 1};
  }

  // The most light of peaks that lie upon one another, beyond what an even field has there.
  double crowded_light(bool is_sample) const {
    double most = 0;
    for (const auto& [cell, sampled] : cells_) {
      // Four cells of one particle each are too few, so a square that tells something has another.
      if (is_sample && sampled.count < fewest / 4) continue;
      const auto x = static_cast<std::int32_t>(cell >> 32);
      const auto y = static_cast<std::int32_t>(cell & 0xffffffffu);
      // The four squares of two cells by two with this one.
      for (const int left : {x - 1, x}) {
        for (const int top : {y - 1, y})
          most = light_of_square(left, top, is_sample, most);
      }
    }
    return most;
  }

 private:
  static std::uint64_t key(std::int32_t x, std::int32_t y) {
    return std::uint64_t{static_cast<std::uint32_t>(x)} << 32 | static_cast<std::uint32_t>(y);
  }
  std::int32_t cell_of(double place) const {
    constexpr double farthest = 1e9;  // clouds as wide may lie as far beside the picture
    return static_cast<std::int32_t>(
        std::clamp(std::floor(std::ldexp(place, -shift_)), -farthest, farthest));
  }
  Sampled sum(int left, int top, int side) const {
    Sampled all;
    for (int y = top; y < top + side; ++y) {
      for (int x = left; x < left + side; ++x) {
        const auto found = cells_.find(key(x, y));
        if (found != cells_.end()) all += found->second;
      }
    }
    return all;
  }
  // Or `least`, where it is less.
  double light_of_square(int left, int top, bool is_sample, double least) const {
    constexpr double square = 4, around = 32;
    const Sampled here = sum(left, top, 2);
    if (is_sample && here.count < fewest) return least;
    const double certain = is_sample ? 1 - deviations / std::sqrt(here.count) : 1;
    if (certain * here.peak <= least) return least;
    const double beside = sum(left - 2, top - 2, 6).peak - here.peak;
    return std::max(least, certain * here.peak - beside * square / around);
  }

  GridsOfSplats on_;
  int shift_;
  std::unordered_map<std::uint64_t, Sampled> cells_;
};

GridsOfSplats grids_of(const SampledCloud& cloud, double sigma, const FramePlan& plan) {
  const GridPyramid& pyramid = plan.pyramid;
  const double ratio =
      std::ldexp(pyramid.over_least_width(sigma, cloud.light), -pyramid.first_level);
  if (ratio < 1) return {};
  const int coarsest = static_cast<int>(pyramid.level_grids.size()) - 1;
  return {std::min(std::ilogb(ratio) + pyramid.first_level, coarsest), false};
}

// Octaves on the picture's own grid, and on coarse ones.
using Samples = std::array<std::vector<OctaveSample>, width_octaves>;

Samples collect(const std::vector<SampledCloud>& clouds, const FramePlan& plan) {
  Samples samples;
  for (const SampledCloud& cloud : clouds) {
    const double sigma = drawn_sigma(cloud, plan);
    const int octave = width_octave(sigma);
    const GridsOfSplats on = grids_of(cloud, sigma, plan);
    std::vector<OctaveSample>& of_octave = samples[static_cast<std::size_t>(octave)];
    auto at = std::find_if(of_octave.begin(), of_octave.end(),
                           [&](const OctaveSample& one) { return one.on() == on; });
    if (at == of_octave.end()) at = of_octave.insert(at, OctaveSample(octave, on));
    const auto bright = static_cast<double>(plan.splats.bright_peak);
    at->add(cloud, on.are_picture ? bright : cloud.light);
  }
  return samples;
}

// What splats of one octave on one grid do where most lie upon one another.
struct Crowd {
  int octave;
  GridsOfSplats on;
  double light, error;  // over what is promised
  double light_of_means;
};

std::vector<Crowd> crowds_of(const std::vector<SampledCloud>& clouds, bool is_sample,
                             const Frame& frame, const FramePlan& plan) {
  const Samples samples = collect(clouds, plan);
  std::vector<Crowd> crowds;
  for (int octave = 0; octave < width_octaves; ++octave) {
    for (const OctaveSample& sample : samples[static_cast<std::size_t>(octave)]) {
      PeakCells nothing;
      nothing.octave = octave;
      nothing.level = sample.on().level;
      nothing.is_beside_picture = sample.on().level == 0 && !sample.on().are_picture;
      nothing.peaks = nothing.endings = {1, 1, 1, {0}};
      const OctaveErrors errors(nothing, frame, plan);
      const double light = sample.crowded_light(is_sample);
      crowds.push_back({octave, sample.on(), light,
                        std::min(errors.peak_error() * light, errors.part_of_itself(light)) /
                            plan.shares.promise,
                        errors.light_of_means()});
    }
  }
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

// Of a part of the particles none knows how unevenly all of them lie. Sums without an order are
// drawn so fast that it would take a part of that, and slabs have ends of their own.
bool can_expect_ends(const Frame& frame, const FramePlan& plan, bool is_sample) {
  return plan.needs_sort() && plan.slabs == 0 && !is_sample && !frame.kernel.cut;
}

// What light without absorption needs is guessed from how bright it is (make_plan.cpp).
bool can_be_expected(const FramePlan& plan) {
  return !plan.is_extended() && !plan.certify && !plan.has_ellipses &&
         plan.light != LightPlan::emission;
}

void all_cores(std::size_t count, std::size_t block_size,
               const std::function<void(std::size_t, std::size_t)>& work) {
  for_blocks(count, block_size, work);
}

// `error` is the most that any of them do.
void add_needs_of_crowds(const std::vector<Crowd>& crowds, double error, double times,
                         bool knows_ends, const FramePlan& plan, SplatNeeds& needs) {
  double on_grids = 0;
  for (const Crowd& crowd : crowds) {
    if (!crowd.on.are_picture) on_grids = std::max(on_grids, crowd.light);
  }
  needs.grid_light = std::max(1.0, times * on_grids);
  for (const Crowd& crowd : crowds) {
    const auto octave = static_cast<std::size_t>(crowd.octave);
    WidthNeed& need = needs.widths[octave];
    if (crowd.light > 0 && !knows_ends) need.farther = std::log(times * error);
    // Beside the picture's own grid no blurred grid may be good enough: they are drawn on it then.
    if (crowd.on.level > 0 || crowd.error <= 0) continue;
    const double had = std::max(1.0, plan.needs.widths[octave].light);
    const double in_proportion = std::min(times * error * had, crowd.light_of_means);
    need.light = std::max({need.light, times * crowd.light, in_proportion});
  }
}

void add_needs_of_ends(const ExpectedEnds& ends, SplatNeeds& needs) {
  constexpr double least_part = 0.03;  // octaves that do less are not drawn farther
  constexpr double left = 0.3;         // of what is promised
  for (std::size_t octave = 0; octave < needs.widths.size(); ++octave) {
    if (ends.of_octaves[octave] > least_part)
      needs.widths[octave].farther = std::log(ends.error / left);
  }
}

}  // namespace

std::optional<SplatNeeds> expected_needs(const Frame& frame, const FramePlan& plan,
                                         bool on_all_cores) {
  // What may be left to the check: more where only a sample is known.
  constexpr double most_of_sample = 1, most_of_all = 0.3, most_of_ends = 0.7;
  if (!can_be_expected(plan)) return std::nullopt;
  const BlockLoop loop = on_all_cores ? all_cores : one_after_the_other;
  const std::vector<SampledCloud> clouds = sample_clouds(frame, loop);
  const bool is_sample = !clouds.empty() && clouds.front().weight > 1;
  const bool knows_ends = can_expect_ends(frame, plan, is_sample);
  SplatNeeds needs;
  bool are_any = false;
  if (knows_ends || can_expect_crowds(frame, plan)) {
    const std::vector<Crowd> crowds = crowds_of(clouds, is_sample, frame, plan);
    const double error = most_error(crowds), times = is_sample ? margin_of_sample : margin_of_all;
    if (error > (knows_ends ? most_of_all : most_of_sample)) {
      add_needs_of_crowds(crowds, error, times, knows_ends, plan, needs);
      are_any = true;
    }
  }
  if (knows_ends) {
    const ExpectedEnds ends = expected_ends(clouds, frame, plan, loop);
    if (ends.error > most_of_ends) {
      add_needs_of_ends(ends, needs);
      are_any = true;
    }
  }
  return are_any ? std::optional<SplatNeeds>(needs) : std::nullopt;
}

}  // namespace splotchcl
