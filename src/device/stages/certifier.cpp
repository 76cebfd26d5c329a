#include "device/stages/certifier.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "device/opencl/launch.h"

namespace splotchcl {
namespace {

// No wider than the smallest tile.
constexpr int widest_shift = 4;
// No narrower than two pixels, and four for peaks: together they take 3.5 bytes per pixel.
constexpr int narrowest_ending_shift = 1, narrowest_peak_shift = 2;

// Cells of an octave are as wide as its widest splats.
int cell_shift(int octave, int narrowest) {
  return std::clamp(octave, narrowest, widest_shift);
}

// Where the cells of a tile of `width` by `height` pixels begin, octave by octave.
void lay_out(int narrowest, std::uint32_t width, std::uint32_t height, shared::OctaveCells* octaves,
             std::uint32_t& count) {
  for (int octave = 0; octave < WIDTH_OCTAVES; ++octave) {
    const int shift = cell_shift(octave, narrowest);
    octaves[octave] = {count, shift};
    count += (width >> shift) * (height >> shift);
  }
}

// Whether nothing was collected of an octave in any tile of a grid.
bool is_empty(const std::vector<float>& values, std::size_t cells_per_tile,
              const shared::OctaveCells& octave, std::size_t cell_count, const shared::Grid& grid) {
  const std::size_t tiles =
      static_cast<std::size_t>(grid.tiles_x) * static_cast<std::size_t>(grid.tiles_y);
  for (std::size_t tile = grid.first_tile; tile < grid.first_tile + tiles; ++tile) {
    const float* first = values.data() + tile * cells_per_tile + octave.first;
    if (std::any_of(first, first + cell_count, [](float value) { return value != 0; }))
      return false;
  }
  return true;
}

// The cells of one octave in all tiles of a grid.
CellSums gather(const std::vector<float>& values, std::size_t cells_per_tile,
                const shared::OctaveCells& octave, const shared::Grid& grid, int tile_width,
                int tile_height) {
  const int across = tile_width >> octave.shift, along = tile_height >> octave.shift;
  CellSums sums;
  sums.side = 1 << octave.shift;
  sums.columns = grid.tiles_x * across;
  sums.rows = grid.tiles_y * along;
  sums.values.resize(static_cast<std::size_t>(sums.columns) * static_cast<std::size_t>(sums.rows));
  auto to = sums.values.begin();
  for (int row = 0; row < sums.rows; ++row) {
    for (int column = 0; column < grid.tiles_x; ++column) {
      const auto tile = static_cast<std::size_t>(row / along * grid.tiles_x + column);
      const std::size_t from = (grid.first_tile + tile) * cells_per_tile + octave.first +
                               static_cast<std::size_t>(row % along * across);
      to = std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(from), across, to);
    }
  }
  return sums;
}

// A blurred grid's splats are drawn narrower and brighter than they are: by as much as the
// octave's widest at least.
void take_back_blur(double blur, int octave, std::vector<float>& peaks) {
  const double widest = std::exp2(octave);
  const auto scale = static_cast<float>(1 - blur / (widest * widest));
  for (float& peak : peaks)
    peak *= scale;
}

}  // namespace

Certifier::Certifier(const StageContext& context) : context_(context) {
  if (context.plan.is_extended()) return;
  const Specialization& specialization = context.specialization;
  program_ = context.device.programs.get(specialization.certify());
  parameters_.grid_count = static_cast<std::uint32_t>(context.layout.grids.size());
  for (const auto& [narrowest, octaves] :
       {std::pair(narrowest_peak_shift, parameters_.peaks),
        std::pair(narrowest_ending_shift, parameters_.endings)}) {
    lay_out(narrowest, specialization.tile_width(), specialization.tile_height(), octaves,
            parameters_.cells_per_tile);
  }
  parameters_.listed = parameters_.cells_per_tile++;
  const SplatLimits& limits = context.plan.splats;
  parameters_.widening = limits.widening;
  parameters_.bright_peak = limits.bright_peak;
  const float least2 = limits.least_extent * limits.least_extent;
  parameters_.edge_peak = std::exp(least2) / limits.inverse_edge;
  for (std::size_t octave = 0; octave < std::size(parameters_.extent2); ++octave)
    parameters_.extent2[octave] =
        least2 + static_cast<float>(context.plan.needs.widths[octave].farther);
  const GridPyramid& pyramid = context.plan.pyramid;
  for (int i = 0; i < 2; ++i)
    parameters_.blur[i] = pyramid.is_blurred ? static_cast<float>(pyramid.blur[i]) : 0.0f;
}

void Certifier::start() {
  const std::uint64_t floats =
      std::uint64_t{context_.layout.tile_count} * parameters_.cells_per_tile;
  cells_ = context_.device.pool.get<float>(floats, "peak cells");
  const cl_float zero = 0;
  context_.device.timer.add(
      "certify", context_.device.queue.enqueue_fill_buffer(cells_.memory(), &zero, sizeof(zero), 0,
                                                           floats * sizeof(float)));
  has_started_ = true;
}

void Certifier::collect(const TileLists& lists) {
  if (context_.plan.is_extended() || lists.segment_count == 0) return;
  if (!has_started_) start();
  shared::CertifyParameters parameters = parameters_;
  parameters.segment_count = lists.segment_count;
  Launch(context_.device, "certify", program_.create_kernel("collect"))
      .value(parameters)
      .arg(context_.grids)
      .arg(lists.segments)
      .arg(lists.entries)
      .arg(cells_)
      .run_items(lists.segment_count);
}

CollectedSplats Certifier::collected() const {
  CollectedSplats found;
  if (!has_started_) return found;
  const std::vector<float> values = context_.device.pool.download(cells_, cells_.size());
  for (std::size_t i = parameters_.listed; i < values.size(); i += parameters_.cells_per_tile)
    found.longest_list = std::max(found.longest_list, static_cast<double>(values[i]));
  const int tile_width = static_cast<int>(context_.specialization.tile_width());
  const int tile_height = static_cast<int>(context_.specialization.tile_height());
  for (std::size_t g = 0; g < context_.layout.grids.size(); ++g) {
    const shared::Grid& grid = context_.layout.grids[g];
    const int level = context_.plan.pyramid.grids[g].level;
    const double blur = g == 0 ? 0 : static_cast<double>(parameters_.blur[g % 2 == 0]);
    for (int octave = 0; octave < WIDTH_OCTAVES; ++octave) {
      const shared::OctaveCells& peaks = parameters_.peaks[octave];
      const auto cell_count =
          static_cast<std::size_t>((tile_width >> peaks.shift) * (tile_height >> peaks.shift));
      if (is_empty(values, parameters_.cells_per_tile, peaks, cell_count, grid)) continue;
      PeakCells cells;
      cells.peaks =
          gather(values, parameters_.cells_per_tile, peaks, grid, tile_width, tile_height);
      if (blur > 0) take_back_blur(blur, octave, cells.peaks.values);
      cells.endings = gather(values, parameters_.cells_per_tile, parameters_.endings[octave], grid,
                             tile_width, tile_height);
      cells.level = level;
      cells.left = grid.first_x - grid.guard;
      cells.top = grid.first_y - grid.guard;
      cells.octave = octave + level;
      found.cells.push_back(std::move(cells));
    }
  }
  return found;
}

}  // namespace splotchcl
