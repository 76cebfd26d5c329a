#include "device/stages/certifier.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "certificate/cells.h"
#include "device/frame/stage_context.h"
#include "device/opencl/launch.h"
#include "device/stages/stage_programs.h"
#include "parallel/for_blocks.h"
#include "scene/plan/splat_limits.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// Where the cells of a tile of `width` by `height` pixels begin, octave by octave.
void lay_out(int (*shift_of)(int octave), std::uint32_t width, std::uint32_t height,
             shared::OctaveCells* octaves, std::uint32_t& count) {
  for (int octave = 0; octave < WIDTH_OCTAVES; ++octave) {
    const int shift = shift_of(octave);
    octaves[octave] = {count, 2 * shift};
    count += (width >> shift) * (height >> shift);
  }
}

int side_of(const shared::OctaveCells& octave) {
  return 1 << octave.pixel_bits / 2;
}

// Of the cells in a row of a tile, among those of their octave in the tile.
std::vector<std::size_t> numbers_of_cells(int columns, int row) {
  std::vector<std::size_t> numbers(static_cast<std::size_t>(columns));
  for (std::size_t column = 0; column < numbers.size(); ++column) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      numbers[column] |= (column >> bit & 1) << 2 * bit;
      numbers[column] |= (static_cast<std::size_t>(row) >> bit & 1) << (2 * bit + 1);
    }
  }
  return numbers;
}

struct TileCells {
  const float* values;
  std::size_t cells_per_tile;
  int tile_width, tile_height;

  std::size_t first_of(std::size_t tile, const shared::OctaveCells& octave) const {
    return tile * cells_per_tile + octave.first;
  }
  bool is_empty(const shared::OctaveCells& octave, const shared::Grid& grid) const {
    const auto tiles =
        static_cast<std::size_t>(grid.tiles_x) * static_cast<std::size_t>(grid.tiles_y);
    const auto cells = static_cast<std::size_t>((tile_width * tile_height) >> octave.pixel_bits);
    for (std::size_t tile = grid.first_tile; tile < grid.first_tile + tiles; ++tile) {
      const float* first = values + first_of(tile, octave);
      if (std::any_of(first, first + cells, [](float value) { return value != 0; })) return false;
    }
    return true;
  }

  CellSums sums_of(const shared::OctaveCells& octave, const shared::Grid& grid) const {
    CellSums sums;
    sums.side = side_of(octave);
    sums.columns = grid.tiles_x * (tile_width / sums.side);
    sums.rows = grid.tiles_y * (tile_height / sums.side);
    sums.values.resize(static_cast<std::size_t>(sums.columns) *
                       static_cast<std::size_t>(sums.rows));
    return sums;
  }

  void add_row(const shared::OctaveCells& octave, const shared::Grid& grid, int tile_row,
               CellSums& sums) const {
    const int across = tile_width / side_of(octave), along = tile_height / side_of(octave);
    float* to = sums.values.data() + std::ptrdiff_t{tile_row} * along * sums.columns;
    for (int row = 0; row < along; ++row) {
      const std::vector<std::size_t> numbers = numbers_of_cells(across, row);
      for (int column = 0; column < grid.tiles_x; ++column) {
        const auto tile = static_cast<std::size_t>(tile_row * grid.tiles_x + column);
        const float* const from = values + first_of(grid.first_tile + tile, octave);
        for (const std::size_t number : numbers)
          *to++ += from[number];
      }
    }
  }
};

// An octave of splats on the grids of a level: those that have some, and what is gathered of them.
struct OctaveOfLevel {
  std::size_t first_grid, end_grid;
  int octave;
  std::vector<std::size_t> grids;
  PeakCells cells;
};

struct TileRow {
  std::size_t octave;
  int row;
};

// The picture's own grid is a level of its own, apart from others that are as fine.
std::vector<OctaveOfLevel> octaves_of_levels(const GridPyramid& pyramid) {
  const std::size_t levels = (pyramid.grids.size() - 1) / pyramid.grids_of_level();
  std::vector<OctaveOfLevel> octaves;
  for (std::size_t level = 0; level <= levels; ++level) {
    const std::size_t first = level == 0 ? 0 : 1 + (level - 1) * pyramid.grids_of_level();
    const std::size_t end = level == 0 ? 1 : first + pyramid.grids_of_level();
    for (int octave = 0; octave < WIDTH_OCTAVES; ++octave)
      octaves.push_back({first, end, octave, {}, {}});
  }
  return octaves;
}

double longest_list(const float* listed, std::size_t tiles, std::size_t cells_per_tile) {
  float longest = 0;
  for (std::size_t tile = 0; tile < tiles; ++tile)
    longest = std::max(longest, listed[tile * cells_per_tile]);
  return static_cast<double>(longest);
}

}  // namespace

void lay_out_cells(const Variant& variant, shared::CertifyParameters& parameters) {
  const std::uint32_t width = variant.tile_width, height = variant.tile_height;
  if (width != height && width != 2 * height) {
    throw DeviceError("tiles of " + std::to_string(width) + "x" + std::to_string(height) +
                      " pixels: they have to be squares, or twice as wide as high");
  }
  parameters.cells_per_tile = 0;
  for (const auto& [shift_of, octaves] : {std::pair(&peak_cell_shift, parameters.peaks),
                                          std::pair(&ending_cell_shift, parameters.endings)}) {
    lay_out(shift_of, width, height, octaves, parameters.cells_per_tile);
  }
  parameters.listed = parameters.cells_per_tile++;
}

Certifier::Certifier(const StageContext& context) : context_(context) {
  if (!context.plan.has_errors_of_splats) return;
  const Variant& variant = context.variant;
  program_ = context.device.programs.get(certify_program(variant));
  parameters_.grid_count = static_cast<std::uint32_t>(context.layout.grids.size());
  lay_out_cells(variant, parameters_);
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

void Certifier::begin(Buffer<float>& cells) const {
  if (!context_.plan.has_errors_of_splats || cells.size() > 0) return;
  cells = room();
  clear_memory(context_.device, "certify", cells.memory(), 0, cells.size() * sizeof(float));
}

void Certifier::collect(const TileLists& lists, Buffer<float>& cells) const {
  if (!context_.plan.has_errors_of_splats || lists.segment_count == 0) return;
  begin(cells);
  shared::CertifyParameters parameters = parameters_;
  parameters.segment_count = lists.segment_count;
  if (!context_.variant.rows) {
    collect_in_groups(lists, parameters, cells);
    return;
  }
  Launch(context_.device, "certify", program_.create_kernel("collect"))
      .value(parameters)
      .arg(context_.grids)
      .arg(lists.segments)
      .arg(lists.entries)
      .arg(cells)
      .run_pieces(lists.segment_count);
}

void Certifier::collect_in_groups(const TileLists& lists,
                                  const shared::CertifyParameters& parameters,
                                  const Buffer<float>& cells) const {
  DeviceContext& device = context_.device;
  const auto partial_cells = device.pool.get<float>(
      std::uint64_t{lists.partial_count} * parameters.cells_per_tile, "cells of segments");
  Launch(device, "certify", program_.create_kernel("collect"))
      .value(parameters)
      .arg(context_.grids)
      .arg(lists.segments)
      .arg(lists.entries)
      .arg(cells)
      .arg(partial_cells)
      .run_groups(lists.segment_count, GROUP_ITEMS);
  if (lists.partial_count == 0) return;
  Launch(device, "certify", program_.create_kernel("collect_segments"))
      .value(parameters)
      .arg(lists.segments)
      .arg(cells)
      .arg(partial_cells)
      .run_groups(lists.segment_count, GROUP_ITEMS);
}

CellsOfTiles Certifier::read(const Buffer<float>& cells) const {
  CellsOfTiles read;
  if (cells.size() == 0) return read;
  const MappedValues<const float> values = context_.device.pool.map_to_read(cells);
  read.values.assign(values.data(), values.data() + values.size());
  read.parameters = parameters_;
  read.tile_count = context_.layout.tile_count;
  read.tile_width = static_cast<int>(context_.variant.tile_width);
  read.tile_height = static_cast<int>(context_.variant.tile_height);
  read.grids = context_.layout.grids;
  read.pyramid = context_.plan.pyramid;
  return read;
}

// Of all octaves and levels that have some. All cores read what lies far apart: octaves first, to
// see which there are, then rows of tiles of these.
void CellsOfTiles::gather(CollectedSplats& splats) const {
  if (values.empty()) return;
  splats.longest_list =
      longest_list(values.data() + parameters.listed, tile_count, parameters.cells_per_tile);
  const TileCells tiles = {values.data(), parameters.cells_per_tile, tile_width, tile_height};
  std::vector<OctaveOfLevel> octaves = octaves_of_levels(pyramid);
  for_blocks(octaves.size(), 1, [&](std::size_t number, std::size_t) {
    OctaveOfLevel& own = octaves[number];
    const shared::OctaveCells& peaks = parameters.peaks[own.octave];
    const shared::OctaveCells& endings = parameters.endings[own.octave];
    for (std::size_t g = own.first_grid; g < own.end_grid; ++g) {
      // Bright splats end where those of wider octaves do.
      if (!tiles.is_empty(peaks, grids[g]) || !tiles.is_empty(endings, grids[g]))
        own.grids.push_back(g);
    }
  });
  std::vector<TileRow> rows;
  for (std::size_t number = 0; number < octaves.size(); ++number) {
    OctaveOfLevel& own = octaves[number];
    if (own.grids.empty()) continue;
    const shared::Grid& grid = grids[own.grids.back()];
    own.cells.level = pyramid.grids[own.first_grid].level;
    own.cells.is_beside_picture = own.cells.level == 0 && own.first_grid > 0;
    own.cells.octave = own.octave + own.cells.level;
    own.cells.left = grid.first_x - grid.guard;
    own.cells.top = grid.first_y - grid.guard;
    own.cells.peaks = tiles.sums_of(parameters.peaks[own.octave], grid);
    own.cells.endings = tiles.sums_of(parameters.endings[own.octave], grid);
    for (int row = 0; row < grid.tiles_y; ++row)
      rows.push_back({number, row});
  }
  constexpr std::size_t rows_at_a_time = 8;
  for_blocks(rows.size(), rows_at_a_time, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      OctaveOfLevel& own = octaves[rows[i].octave];
      for (const std::size_t g : own.grids) {
        tiles.add_row(parameters.peaks[own.octave], grids[g], rows[i].row, own.cells.peaks);
        tiles.add_row(parameters.endings[own.octave], grids[g], rows[i].row, own.cells.endings);
      }
    }
  });
  for (OctaveOfLevel& own : octaves) {
    if (!own.grids.empty()) splats.cells.push_back(std::move(own.cells));
  }
}

}  // namespace splotchcl
