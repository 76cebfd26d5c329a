#include "device/stages/group_binner.h"

#include <algorithm>
#include <utility>

#include "device/opencl/launch.h"
#include "device/stages/binner.h"
#include "device/stages/clear_memory.h"
#include "device/stages/stage_programs.h"
#include "scene/ceil_divide.h"

namespace splotchcl {
namespace {

std::uint32_t splats_of(const shared::BinParameters& parameters) {
  return parameters.end - parameters.first;
}

}  // namespace

// A splat of many tiles is 1 at its first corner and -1 beyond the others: summed along rows and
// columns that is 1 in its tiles. Sums wrap around on their way.
std::vector<std::uint32_t> lengths_of_lists(const std::vector<std::uint32_t>& counts,
                                            const PictureLayout& layout) {
  std::vector<std::uint32_t> lengths(layout.tile_count);
  for (const shared::Grid& grid : layout.grids) {
    const auto columns = static_cast<std::size_t>(grid.tiles_x);
    const auto rows = static_cast<std::size_t>(grid.tiles_y);
    std::vector<std::uint32_t> of_row_above(columns, 0);
    for (std::size_t row = 0; row < rows; ++row) {
      std::uint32_t in_row = 0;
      for (std::size_t column = 0; column < columns; ++column) {
        const std::size_t tile = grid.first_tile + row * columns + column;
        in_row += counts[layout.tile_count + tile];
        of_row_above[column] += in_row;
        lengths[tile] = counts[tile] + of_row_above[column];
      }
    }
  }
  return lengths;
}

std::vector<shared::Segment> cut_in_segments(const std::vector<std::uint32_t>& lengths,
                                             const TileBand& band, std::uint32_t segment_length) {
  std::vector<shared::Segment> segments;
  std::uint32_t begin = 0, partials = 0;
  for (std::uint32_t tile = band.first; tile < band.end; ++tile) {
    const std::uint32_t end = begin + lengths[tile];
    const bool is_cut = lengths[tile] > segment_length;
    while (begin < end) {
      const std::uint32_t length = std::min(segment_length, end - begin);
      segments.push_back({tile, begin, begin + length, is_cut ? partials++ : NO_PARTIAL});
      begin += length;
    }
  }
  return segments;
}

GroupBinner::GroupBinner(const StageContext& context)
    : context_(context),
      program_(context.device.programs.get(bin_program(context.variant))),
      scan_(context.device),
      sorter_(context.device) {}

void GroupBinner::count(CountedSplats& counted) const {
  DeviceContext& device = context_.device;
  const shared::GroupBinParameters parameters = {counted.parameters, 0};
  const std::uint32_t splats = splats_of(counted.parameters);
  if (splats == 0) {
    counted.lengths.assign(counted.parameters.tile_count, 0);
    return;
  }
  const std::uint64_t counters = 2 * std::uint64_t{counted.parameters.tile_count};
  const std::uint64_t in_copies = COPIES_OF_COUNTS * counters;
  counted.tiles_of_splats = device.pool.get<shared::SplatTiles>(splats, "tiles of splats");
  counted.tile_counts = device.pool.get<std::uint32_t>(in_copies, "tile counts");
  clear_memory(device, "bin", counted.tile_counts.memory(), 0, in_copies * sizeof(std::uint32_t));
  Launch(device, "bin", program_.create_kernel("bin_find_tiles"))
      .value(parameters)
      .arg(context_.grids)
      .arg(*counted.splats)
      .arg(*counted.order)
      .arg(counted.tiles_of_splats)
      .arg(counted.tile_counts)
      .run_groups(ceil_divide(splats, GROUP_ITEMS), GROUP_ITEMS);
  Launch(device, "bin", program_.create_kernel("bin_add_counts"))
      .value(parameters)
      .arg(counted.tile_counts)
      .run_groups(ceil_divide(counters, std::uint64_t{GROUP_ITEMS}), GROUP_ITEMS);
  counted.lengths =
      lengths_of_lists(device.pool.download(counted.tile_counts, counters), context_.layout);
}

// Where the entries of each splat begin.
Buffer<std::uint32_t> GroupBinner::find_entries(
    const CountedSplats& counted, const shared::GroupBinParameters& parameters) const {
  DeviceContext& device = context_.device;
  const std::uint32_t splats = splats_of(parameters.bin);
  Buffer<std::uint32_t> first_entries =
      device.pool.get<std::uint32_t>(std::uint64_t{splats} + 1, "first entries");
  Launch(device, "bin", program_.create_kernel("bin_count_entries"))
      .value(parameters)
      .arg(counted.tiles_of_splats)
      .arg(first_entries)
      .run_groups(ceil_divide(splats, GROUP_ITEMS), GROUP_ITEMS);
  scan_.scan("bin", first_entries, splats);
  return first_entries;
}

// Tiles and splats of all entries, in the splats' order.
KeyedValues GroupBinner::emit(const CountedSplats& counted,
                              const shared::GroupBinParameters& parameters) const {
  DeviceContext& device = context_.device;
  const Buffer<std::uint32_t> first_entries = find_entries(counted, parameters);
  KeyedValues pairs = {device.pool.get<std::uint32_t>(parameters.entry_count, "tiles of entries"),
                       device.pool.get<std::uint32_t>(parameters.entry_count, "splats of entries")};
  Launch(device, "bin", program_.create_kernel("bin_emit"))
      .value(parameters)
      .arg(*counted.order)
      .arg(counted.tiles_of_splats)
      .arg(first_entries)
      .arg(pairs.keys)
      .arg(pairs.values)
      .run_groups(ceil_divide(parameters.entry_count, GROUP_ITEMS), GROUP_ITEMS);
  return pairs;
}

void GroupBinner::make_lists(const CountedSplats& counted, const TileBand& band,
                             TileLists& lists) const {
  DeviceContext& device = context_.device;
  shared::GroupBinParameters parameters = {counted.parameters, 0};
  parameters.bin.first_tile = band.first;
  parameters.bin.end_tile = band.end;
  parameters.entry_count = static_cast<std::uint32_t>(lists.entry_count);
  lists.segments = device.pool.upload(
      cut_in_segments(counted.lengths, band, parameters.bin.segment_length), "segments");
  KeyedValues pairs = emit(counted, parameters);
  pairs =
      sorter_.sort("bin", std::move(pairs), parameters.entry_count,
                   digits_of_bits(bits_of(band.end - band.first - 1) + parameters.bin.has_parts));
  lists.entries = device.pool.get<std::byte>(
      lists.entry_count * context_.variant.tile_splat_bytes(), "tile entries");
  Launch(device, "bin", program_.create_kernel("bin_make_entries"))
      .value(parameters)
      .arg(context_.grids)
      .arg(*counted.splats)
      .arg(pairs.keys)
      .arg(pairs.values)
      .arg(context_.colors.components)
      .arg(context_.colors.knots)
      .arg(lists.entries)
      .run_groups(ceil_divide(parameters.entry_count, GROUP_ITEMS), GROUP_ITEMS);
}

}  // namespace splotchcl
