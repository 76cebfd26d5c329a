#include "device/stages/certifier.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "device/frame/cell_layout.h"
#include "device/opencl/launch.h"
#include "device/stages/clear_memory.h"
#include "parallel/for_blocks.h"
#include "scene/plan/splat_limits.h"

namespace splotchcl {
namespace {

// What was collected, tile by tile.
struct CellsOfTiles {
  const float* values;
  std::size_t cells_per_tile;
  int tile_width, tile_height;

  std::size_t first_of(std::size_t tile, const shared::OctaveCells& octave) const {
    return tile * cells_per_tile + octave.first;
  }
  // Whether nothing was collected of the octave in any tile of the grid.
  bool is_empty(const shared::OctaveCells& octave, const shared::Grid& grid) const;
  // Adds the cells of the octave in all tiles of the grid to those of grids of its level.
  void gather(const shared::OctaveCells& octave, const shared::Grid& grid, CellSums& sums) const;
};

bool CellsOfTiles::is_empty(const shared::OctaveCells& octave, const shared::Grid& grid) const {
  const auto tiles =
      static_cast<std::size_t>(grid.tiles_x) * static_cast<std::size_t>(grid.tiles_y);
  const auto cells =
      static_cast<std::size_t>((tile_width >> octave.shift) * (tile_height >> octave.shift));
  for (std::size_t tile = grid.first_tile; tile < grid.first_tile + tiles; ++tile) {
    const float* first = values + first_of(tile, octave);
    if (std::any_of(first, first + cells, [](float value) { return value != 0; })) return false;
  }
  return true;
}

void CellsOfTiles::gather(const shared::OctaveCells& octave, const shared::Grid& grid,
                          CellSums& sums) const {
  const int across = tile_width >> octave.shift, along = tile_height >> octave.shift;
  sums.side = 1 << octave.shift;
  sums.columns = grid.tiles_x * across;
  sums.rows = grid.tiles_y * along;
  sums.values.resize(static_cast<std::size_t>(sums.columns) * static_cast<std::size_t>(sums.rows));
  float* to = sums.values.data();
  for (int row = 0; row < sums.rows; ++row) {
    for (int column = 0; column < grid.tiles_x; ++column, to += across) {
      const auto tile = static_cast<std::size_t>(row / along * grid.tiles_x + column);
      const float* const from = values + first_of(grid.first_tile + tile, octave) +
                                static_cast<std::size_t>(row % along * across);
      std::transform(from, from + across, to, to, std::plus<>());
    }
  }
}

}  // namespace

Certifier::Certifier(const StageContext& context) : context_(context) {
  if (!context.plan.has_errors_of_splats) return;
  const Specialization& specialization = context.specialization;
  program_ = context.device.programs.get(specialization.certify());
  parameters_.grid_count = static_cast<std::uint32_t>(context.layout.grids.size());
  lay_out_cells(specialization, parameters_);
  const SplatLimits& limits = context.plan.splats;
  parameters_.widening = limits.widening;
  parameters_.bright_peak = limits.bright_peak;
  parameters_.light_behind = static_cast<float>(context.plan.light_behind);
  parameters_.edge_peak = static_cast<float>(edge_peak(limits));
  for (int octave = 0; octave < WIDTH_OCTAVES; ++octave)
    parameters_.extent2[octave] = static_cast<float>(least_extent2(context.plan, octave));
  parameters_.blurs = grid_blurs(context.plan.pyramid);
}

Buffer<float> Certifier::room() const {
  if (!context_.plan.has_errors_of_splats) return {};
  return context_.device.pool.get<float>(
      std::uint64_t{context_.layout.tile_count} * parameters_.cells_per_tile, "peak cells");
}

void Certifier::start() {
  cells_ = room();
  clear_memory(context_.device, "certify", cells_.memory(), 0, cells_.size() * sizeof(float));
}

Buffer<float> Certifier::take_cells() {
  return std::exchange(cells_, {});
}

const Buffer<float>& Certifier::begin_cells() {
  if (context_.plan.has_errors_of_splats && !has_started()) start();
  return cells_;
}

void Certifier::put_cells(Buffer<float> cells) {
  cells_ = std::move(cells);
}

void Certifier::collect(const TileLists& lists) {
  if (!context_.plan.has_errors_of_splats || lists.segment_count == 0) return;
  if (!has_started()) start();
  shared::CertifyParameters parameters = parameters_;
  parameters.segment_count = lists.segment_count;
  if (!context_.device.traits.rows) {
    collect_in_groups(lists, parameters);
    return;
  }
  Launch(context_.device, "certify", program_.create_kernel("collect"))
      .value(parameters)
      .arg(context_.grids)
      .arg(lists.segments)
      .arg(lists.entries)
      .arg(cells_)
      .run_pieces(lists.segment_count);
}

void Certifier::collect_in_groups(const TileLists& lists,
                                  const shared::CertifyParameters& parameters) const {
  DeviceContext& device = context_.device;
  const auto partial_cells = device.pool.get<float>(
      std::uint64_t{lists.partial_count} * parameters.cells_per_tile, "cells of segments");
  Launch(device, "certify", program_.create_kernel("collect"))
      .value(parameters)
      .arg(context_.grids)
      .arg(lists.segments)
      .arg(lists.entries)
      .arg(cells_)
      .arg(partial_cells)
      .run_groups(lists.segment_count, GROUP_ITEMS);
  if (lists.partial_count == 0) return;
  Launch(device, "certify", program_.create_kernel("collect_segments"))
      .value(parameters)
      .arg(lists.segments)
      .arg(cells_)
      .arg(partial_cells)
      .run_groups(lists.segment_count, GROUP_ITEMS);
}

CollectedSplats Certifier::collected() const {
  CollectedSplats found;
  if (!has_started()) return found;
  const MappedValues<const float> values = context_.device.pool.map_to_read(cells_);
  for (std::size_t i = parameters_.listed; i < values.size(); i += parameters_.cells_per_tile)
    found.longest_list = std::max(found.longest_list, static_cast<double>(values.data()[i]));
  const GridPyramid& pyramid = context_.plan.pyramid;
  const std::size_t levels = (pyramid.grids.size() - 1) / pyramid.grids_of_level();
  std::vector<std::optional<PeakCells>> octaves((1 + levels) * WIDTH_OCTAVES);
  for_blocks(octaves.size(), 1, [&](std::size_t first, std::size_t) {
    const auto octave = static_cast<int>(first % WIDTH_OCTAVES);
    const std::size_t level = first / WIDTH_OCTAVES;
    octaves[first] = level == 0 ? octave_of(values.data(), {0, 1}, octave)
                                : octave_of(values.data(),
                                            {1 + (level - 1) * pyramid.grids_of_level(),
                                             1 + level * pyramid.grids_of_level()},
                                            octave);
  });
  for (std::optional<PeakCells>& cells : octaves) {
    if (cells) found.cells.push_back(std::move(*cells));
  }
  return found;
}

// What was collected of an octave of splats on these grids of a level, if there are any.
std::optional<PeakCells> Certifier::octave_of(const float* values, const GridsOfLevel& grids,
                                              int octave) const {
  const CellsOfTiles tiles = {values, parameters_.cells_per_tile,
                              static_cast<int>(context_.specialization.tile_width()),
                              static_cast<int>(context_.specialization.tile_height())};
  const int level = context_.plan.pyramid.grids[grids.first].level;
  const shared::OctaveCells& peaks = parameters_.peaks[octave];
  const shared::OctaveCells& endings = parameters_.endings[octave];
  PeakCells cells;
  cells.level = level;
  cells.is_beside_picture = level == 0 && grids.first > 0;
  cells.octave = octave + level;
  for (std::size_t g = grids.first; g < grids.end; ++g) {
    const shared::Grid& grid = context_.layout.grids[g];
    // Bright splats end where those of wider octaves do.
    if (tiles.is_empty(peaks, grid) && tiles.is_empty(endings, grid)) continue;
    cells.left = grid.first_x - grid.guard;
    cells.top = grid.first_y - grid.guard;
    tiles.gather(peaks, grid, cells.peaks);
    tiles.gather(endings, grid, cells.endings);
  }
  if (cells.peaks.values.empty()) return std::nullopt;
  return cells;
}

}  // namespace splotchcl
