#include "device/stages/binner.h"

#include <algorithm>
#include <utility>

#include "device/frame/stage_context.h"
#include "device/opencl/launch.h"
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

std::vector<TileBand> cut_in_bands(const std::vector<std::uint32_t>& lengths,
                                   std::uint64_t capacity) {
  std::vector<TileBand> bands;
  TileBand band;
  std::uint64_t entries = 0;
  for (const std::uint32_t length : lengths) {
    if (entries > 0 && entries + length > capacity) {
      bands.push_back(band);
      band.first = band.end;
      entries = 0;
    }
    entries += length;
    ++band.end;
  }
  bands.push_back(band);
  return bands;
}

Binner::Binner(const StageContext& context)
    : context_(context),
      program_(context.device.programs.get(bin_program(context.variant))),
      no_order_(context.device.pool.get<std::uint32_t>(0, "unused")),
      no_blocks_(context.device.pool.get<shared::BlockCounts>(0, "unused")) {
  const DeviceTraits& traits = context.device.traits;
  if (!context.variant.rows) groups_.emplace(context);
  entry_capacity_ = entry_capacity(context.plan, traits);
  const PictureLayout& layout = context.layout;
  parameters_.tile_count = layout.tile_count;
  parameters_.has_parts = layout.has_parts() ? 1 : 0;
  parameters_.grid_count = static_cast<std::uint32_t>(layout.grids.size());
  parameters_.segment_length = traits.segment_length;
  parameters_.segment_capacity =
      static_cast<std::uint32_t>(layout.tile_count + entry_capacity_ / traits.segment_length + 1);
  parameters_.end_tile = layout.tile_count;
  parameters_.place_bits = context.layout.grids.front().place_bits;
  parameters_.mean_sigma = context.plan.splats.mean_sigma;
  parameters_.widening = context.plan.splats.widening;
  parameters_.blurs = grid_blurs(context.plan.pyramid);
}

CountedSplats Binner::start(const Buffer<std::byte>& splats) const {
  CountedSplats counted;
  counted.parameters = parameters_;
  counted.splats = &splats;
  counted.order = &no_order_;
  counted.blocks = &no_blocks_;
  return counted;
}

CountedSplats Binner::count(SplatBlocks& blocks) const {
  CountedSplats counted = start(blocks.splats);
  counted.parameters.stride = blocks.stride;
  counted.parameters.length = blocks.stride;
  counted.parameters.end = blocks.block_count * blocks.stride;
  counted.parameters.block_count = blocks.block_count;
  counted.blocks = &blocks.counts;
  if (groups_) {
    counted.parameters.end = blocks.visible;
    counted.order = &blocks.order;
    groups_->count(counted);
  } else {
    counted.in_order = context_.device.pool.get<std::byte>(0, "unused");
    counted.tiles = std::move(blocks.tiles);
    counted.tile_counts = std::move(blocks.tile_counts);
    scan_blocks(counted);
  }
  counted.bands = cut_in_bands(counted.lengths, entry_capacity_);
  return counted;
}

CountedSplats Binner::count(const SortedSplats& sorted, const SplatChunk& chunk) const {
  CountedSplats counted = start(sorted.splats);
  counted.parameters.first = static_cast<std::uint32_t>(chunk.first);
  counted.parameters.end = counted.parameters.first + chunk.count;
  counted.order = &sorted.order;
  if (groups_) {
    groups_->count(counted);
  } else {
    cut_in_blocks(counted);
    count_tiles(counted);
    scan_blocks(counted);
  }
  counted.bands = cut_in_bands(counted.lengths, entry_capacity_);
  return counted;
}

void Binner::cut_in_blocks(CountedSplats& counted) const {
  shared::BinParameters& parameters = counted.parameters;
  const std::uint32_t count = parameters.end - parameters.first;
  const std::uint32_t wanted = context_.device.traits.bin_blocks;
  parameters.stride = std::max(1u, ceil_divide(count, wanted));
  parameters.length = parameters.stride;
  parameters.block_count = ceil_divide(count, parameters.stride);
  const std::uint64_t slots = std::uint64_t{parameters.block_count} * parameters.stride;
  counted.in_order = context_.device.pool.get<std::byte>(slots * context_.variant.splat_bytes(),
                                                         "splats in order");
  counted.tiles = context_.device.pool.get<std::uint32_t>(slots, "tiles of splats");
  counted.tile_counts = context_.device.pool.get<std::uint32_t>(
      counted_tiles(parameters.block_count, context_.layout), "tile counts");
}

void Binner::count_tiles(CountedSplats& counted) const {
  Launch(context_.device, "bin", program_.create_kernel("bin_count"))
      .value(counted.parameters)
      .arg(context_.grids)
      .arg(*counted.splats)
      .arg(*counted.order)
      .arg(counted.tile_counts)
      .arg(counted.tiles)
      .arg(counted.in_order)
      .run_items(counted.parameters.block_count);
}

void Binner::scan_blocks(CountedSplats& counted) const {
  DeviceContext& device = context_.device;
  const shared::BinParameters& parameters = counted.parameters;
  counted.tile_lengths = device.pool.get<std::uint32_t>(parameters.tile_count, "tile lengths");
  Launch(device, "bin", program_.create_kernel("bin_scan_blocks"))
      .value(parameters)
      .arg(counted.tile_counts)
      .arg(counted.tile_lengths)
      .run_grid(ceil_divide(parameters.tile_count, TILES_OF_SCAN), 1, 1);
  counted.lengths = device.pool.download(counted.tile_lengths, parameters.tile_count);
}

TileLists Binner::measure_lists(const std::vector<std::uint32_t>& lengths,
                                const TileBand& band) const {
  const std::vector<shared::Grid>& grids = context_.layout.grids;
  TileLists lists;
  std::size_t grid = 0;
  for (std::uint32_t tile = band.first; tile < band.end; ++tile) {
    while (grid + 1 < grids.size() && tile >= grids[grid + 1].first_tile)
      ++grid;
    const std::uint32_t length = lengths[tile];
    if (length == 0) continue;
    const std::uint32_t segments = ceil_divide(length, parameters_.segment_length);
    lists.entry_count += length;
    lists.segment_count += segments;
    if (grid == 0) lists.picture_segments += segments;
    if (segments > 1) lists.partial_count += segments;
    lists.used_grids |= 1u << grid;
  }
  return lists;
}

TileLists Binner::make_lists(const CountedSplats& counted, const TileBand& band) const {
  TileLists lists = measure_lists(counted.lengths, band);
  if (lists.entry_count == 0) return lists;
  if (groups_) {
    groups_->make_lists(counted, band, lists);
  } else {
    fill_lists(counted, band, lists);
  }
  return lists;
}

void Binner::fill_lists(const CountedSplats& counted, const TileBand& band,
                        TileLists& lists) const {
  DeviceContext& device = context_.device;
  shared::BinParameters parameters = counted.parameters;
  parameters.first_tile = band.first;
  parameters.end_tile = band.end;
  const auto starts = device.pool.get<std::uint32_t>(parameters.tile_count, "tile starts");
  lists.segments = device.pool.get<shared::Segment>(parameters.segment_capacity, "segment");
  // Always the same size, so that the pool's serves again; a processor touches what it fills.
  lists.entries = device.pool.get<std::byte>(
      (entry_capacity_ + ENTRIES_BEHIND) * context_.variant.tile_splat_bytes(), "tile entries");
  Launch(device, "bin", program_.create_kernel("bin_scan_tiles"))
      .value(parameters)
      .arg(counted.tile_lengths)
      .arg(starts)
      .arg(lists.segments)
      .run_items(1);
  Launch scatter(device, "bin", program_.create_kernel("bin_scatter"));
  scatter.value(parameters)
      .arg(context_.grids)
      .arg(*counted.splats)
      .arg(*counted.order)
      .arg(*counted.blocks)
      .arg(counted.tile_counts)
      .arg(counted.tiles)
      .arg(counted.in_order)
      .arg(starts)
      .arg(context_.colors.components)
      .arg(context_.colors.knots)
      .arg(lists.entries);
  // Blocks of sorted splats have as much to do each, and write side by side: threads do best with
  // blocks that follow one another.
  if (context_.plan.needs_sort())
    scatter.run_items(parameters.block_count);
  else
    scatter.run_pieces(parameters.block_count);
}

}  // namespace splotchcl
