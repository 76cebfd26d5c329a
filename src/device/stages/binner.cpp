#include "device/stages/binner.h"

#include <algorithm>

#include "device/opencl/launch.h"
#include "device/stages/stage_programs.h"
#include "scene/ceil_divide.h"

namespace splotchcl {
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

// What a chunk of sorted splats needs to be counted.
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

// What the lists of a band will be, without their memory.
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
