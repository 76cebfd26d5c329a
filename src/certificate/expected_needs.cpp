#include "certificate/expected_needs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include "certificate/octave_errors.h"
#include "certificate/peak_cells.h"
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
constexpr double margin = 2.5, margin_of_sample = 4;

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

int octave_of(double sigma) {
  return sigma < 1 ? 0 : std::min(std::ilogb(sigma) + 1, width_octaves - 1);
}

GridsOfSplats grids_of(const SampledCloud& cloud, double sigma, const FramePlan& plan) {
  const GridPyramid& pyramid = plan.pyramid;
  const bool has_others = pyramid.grids.size() > 1;
  if (!has_others || cloud.light > static_cast<double>(pyramid.coarse_peak)) return {};
  const double ratio =
      std::ldexp(sigma / static_cast<double>(pyramid.coarse_sigma), -pyramid.first_level);
  if (ratio < 1) return {};
  const int coarsest = static_cast<int>(pyramid.level_grids.size()) - 1;
  return {std::min(std::ilogb(ratio) + pyramid.first_level, coarsest), false};
}

// Octaves on the picture's own grid, and on coarse ones.
using Samples = std::array<std::vector<OctaveSample>, width_octaves>;

Samples collect(const std::vector<SampledCloud>& clouds, const FramePlan& plan) {
  Samples samples;
  for (const SampledCloud& cloud : clouds) {
    const double sigma =
        std::sqrt(cloud.sigma * cloud.sigma + static_cast<double>(plan.splats.widening));
    const int octave = octave_of(sigma);
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

bool can_be_expected(const Frame& frame, const FramePlan& plan) {
  if (plan.is_extended() || plan.certify || plan.has_ellipses) return false;
  // What light without absorption needs is guessed from how bright it is (make_plan.cpp).
  if (plan.light == LightPlan::emission) return false;
  // Sources without a brightest, which shine through what absorbs, amplify errors by how bright
  // they are there.
  return plan.light != LightPlan::ordered || std::isfinite(brightest_source(frame));
}

}  // namespace

std::optional<SplatNeeds> expected_needs(const Frame& frame, const FramePlan& plan,
                                         bool on_all_cores) {
  if (!can_be_expected(frame, plan)) return std::nullopt;
  const BlockLoop loop = [](std::size_t count, std::size_t block_size,
                            const std::function<void(std::size_t, std::size_t)>& work) {
    for_blocks(count, block_size, work);
  };
  const std::vector<SampledCloud> clouds = sample_clouds(frame, on_all_cores ? loop : BlockLoop());
  const bool is_sample = !clouds.empty() && clouds.front().weight > 1;
  const std::vector<Crowd> crowds = crowds_of(clouds, is_sample, frame, plan);
  const double times = is_sample ? margin_of_sample : margin;
  double error = 0, on_grids = 0;
  for (const Crowd& crowd : crowds) {
    error = std::max(error, crowd.error);
    if (!crowd.on.are_picture) on_grids = std::max(on_grids, crowd.light);
  }
  if (error <= 1) return std::nullopt;
  SplatNeeds needs;
  needs.grid_light = std::max(1.0, times * on_grids);
  for (const Crowd& crowd : crowds) {
    WidthNeed& need = needs.widths[static_cast<std::size_t>(crowd.octave)];
    if (crowd.light > 0) need.farther = std::log(times * error);
    // Beside the picture's own grid no blurred grid may be good enough: they are drawn on it then.
    if (crowd.on.level > 0 || crowd.error <= 0) continue;
    const double in_proportion = std::min(times * error, crowd.light_of_means);
    need.light = std::max({need.light, times * crowd.light, in_proportion});
  }
  return needs;
}

}  // namespace splotchcl
