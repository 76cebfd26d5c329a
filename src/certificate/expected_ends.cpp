#include "certificate/expected_ends.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "certificate/octave_errors.h"
#include "certificate/peak_cells.h"
#include "certificate/width_octave.h"
#include "scene/plan/splat_limits.h"
#include "splotchcl/frame_check.h"

namespace splotchcl {
namespace {

// Parts of what is promised that do not count.
constexpr double negligible_end = 1e-3;

// Whatever crop of it is drawn.
Frame whole_picture(const Frame& frame) {
  Frame whole;
  whole.width = frame.width;
  whole.height = frame.height;
  whole.crop = {0, 0, frame.width, frame.height};
  whole.kernel = frame.kernel;
  return whole;
}

PeakCells empty_cells(int octave, const Frame& frame) {
  PeakCells cells;
  cells.octave = octave;
  cells.peaks = {1, 1, 1, {0}};
  CellSums& endings = cells.endings;
  const int shift = ending_cell_shift(octave);
  endings.side = 1 << shift;
  endings.columns = ((frame.width - 1) >> shift) + 1;
  endings.rows = ((frame.height - 1) >> shift) + 1;
  endings.values.resize(static_cast<std::size_t>(endings.columns) *
                        static_cast<std::size_t>(endings.rows));
  return cells;
}

// Clouds beside the picture count in the cells at its edge.
int nearest_cell(double place, int side, int count) {
  return static_cast<int>(std::clamp(std::floor(place / side), 0.0, count - 1.0));
}

// What counts of its light for errors (plan.h, light_behind).
double counted_light(const SampledCloud& cloud, const FramePlan& plan) {
  return cloud.light * std::max(cloud.emitted_part, plan.light_behind);
}

// Of the octaves that have any.
std::vector<PeakCells> cells_of(const std::vector<SampledCloud>& clouds, const Frame& frame,
                                const FramePlan& plan) {
  const double brightest = edge_peak(plan.splats);
  std::array<std::optional<PeakCells>, width_octaves> of_octaves;
  for (const SampledCloud& cloud : clouds) {
    const int octave = width_octave(drawn_sigma(cloud, plan));
    std::optional<PeakCells>& cells = of_octaves[static_cast<std::size_t>(octave)];
    if (!cells) cells = empty_cells(octave, frame);
    CellSums& endings = cells->endings;
    const int column = nearest_cell(cloud.x, endings.side, endings.columns);
    const int row = nearest_cell(cloud.y, endings.side, endings.rows);
    endings.values[static_cast<std::size_t>(row) * static_cast<std::size_t>(endings.columns) +
                   static_cast<std::size_t>(column)] +=
        static_cast<float>(cloud.weight * std::min(counted_light(cloud, plan), brightest));
  }
  std::vector<PeakCells> all;
  for (std::optional<PeakCells>& cells : of_octaves) {
    if (cells) all.push_back(std::move(*cells));
  }
  return all;
}

ExpectedEnds ends_in(const PixelBlock& block,
                     const std::vector<std::optional<OctaveErrors>>& octaves, double promise) {
  ExpectedEnds ends;
  for (const std::optional<OctaveErrors>& octave : octaves) {
    const double part = octave->of_ends(block, negligible_end * promise) / promise;
    ends.of_octaves[static_cast<std::size_t>(octave->octave())] = part;
    ends.error += part;
  }
  return ends;
}

}  // namespace

ExpectedEnds expected_ends(const std::vector<SampledCloud>& clouds, const Frame& frame,
                           const FramePlan& plan, const BlockLoop& loop) {
  constexpr std::size_t blocks_at_once = 256;
  const Frame whole = whole_picture(frame);
  const std::vector<PeakCells> cells = cells_of(clouds, whole, plan);
  std::vector<std::optional<OctaveErrors>> octaves(cells.size());
  loop(octaves.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      octaves[i].emplace(cells[i], whole, plan);
  });
  const BlockErrors blocks(frame.width, frame.height);
  std::vector<ExpectedEnds> of_blocks(blocks.errors.size());
  loop(of_blocks.size(), blocks_at_once, [&](std::size_t first, std::size_t last) {
    for (std::size_t b = first; b < last; ++b)
      of_blocks[b] = ends_in(pixels_of_block(b, blocks.columns), octaves, plan.shares.promise);
  });
  return *std::max_element(of_blocks.begin(), of_blocks.end(),
                           [](const auto& a, const auto& b) { return a.error < b.error; });
}

}  // namespace splotchcl
