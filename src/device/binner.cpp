#include "device/binner.h"

#include <algorithm>
#include <vector>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// Lists of one pass; what needs more is drawn in several passes.
constexpr std::uint64_t most_entries = 3u << 20;

int kind_number(Absorption::Kind kind) {
  switch (kind) {
    case Absorption::Kind::as_emission:
      return ABSORPTION_AS_EMISSION;
    case Absorption::Kind::none:
      return ABSORPTION_NONE;
    case Absorption::Kind::factor:
      return ABSORPTION_FACTOR;
    case Absorption::Kind::gray:
      return ABSORPTION_GRAY;
  }
  return ABSORPTION_AS_EMISSION;
}

// Returns the number of the first of them in the table.
std::uint32_t append_knots(const std::vector<Rgb>& added, std::vector<float>& table) {
  const auto first = static_cast<std::uint32_t>(table.size() / 3);
  for (const Rgb& knot : added)
    table.insert(table.end(), knot.begin(), knot.end());
  return first;
}

}  // namespace

Binner::Binner(DeviceContext& device, const FrameLayout& layout, const Frame& frame,
               const Plan& plan, const compute::buffer& grids)
    : device_(device), layout_(layout), grids_(grids) {
  // One splat may lie in every tile.
  entry_capacity_ = std::max<std::uint64_t>(most_entries, layout.tile_count);
  segment_capacity_ = static_cast<std::uint32_t>(
      layout.tile_count + entry_capacity_ / device.traits.segment_length + 1);
  ordered_ = plan.light == LightPlan::ordered;
  entry_bytes_ = layout.exact_numbers ? 4 : (ordered_ ? 40 : 28) + (layout.ellipses ? 8 : 0);

  parameters_.tile_count = layout.tile_count;
  parameters_.grid_count = static_cast<std::uint32_t>(layout.grids.size());
  parameters_.segment_length = device.traits.segment_length;
  parameters_.mean_sigma = layout.mean_sigma;
  parameters_.widening = layout.widening;

  std::string defines = kernel_defines(frame, plan, layout);
  if (!ordered_) defines += "#define BLOCKS_OF_PROJECTION\n";
  program_ = device.programs.get(defines, {"common.cl", "bin.cl"});
  upload_colors(frame);
}

void Binner::upload_colors(const Frame& frame) {
  std::vector<kernel::ComponentColors> colors;
  std::vector<float> knots;
  for (const DrawnComponent& component : frame.components) {
    const Palette& palette = component.palette;
    kernel::ComponentColors entry{};
    entry.first_knot = append_knots(palette.emission, knots);
    entry.knot_count = static_cast<std::uint32_t>(palette.emission.size());
    entry.first_absorption_knot = append_knots(palette.absorption, knots);
    entry.absorption_knot_count = static_cast<std::uint32_t>(palette.absorption.size());
    entry.brightness = static_cast<float>(component.brightness);
    entry.absorption_kind = kind_number(component.absorption.kind);
    entry.absorption_factor = static_cast<float>(component.absorption.factor);
    colors.push_back(entry);
  }
  component_colors_ = device_.buffers.upload("component colours", colors);
  knots_ = device_.buffers.upload("palette knots", knots);
}

bool Binner::bin_blocks(const SplatBlocks& blocks, std::uint32_t first, std::uint32_t length,
                        TileLists& lists) {
  kernel::BinParameters parameters = parameters_;
  parameters.first = first;
  parameters.stride = blocks.stride;
  parameters.length = length;
  parameters.end = blocks.block_count * blocks.stride;
  parameters.block_count = blocks.block_count;
  return bin(parameters, device_.buffers.get("order", 0), lists);
}

bool Binner::bin_order(const compute::buffer& order, std::uint32_t first, std::uint32_t count,
                       TileLists& lists) {
  kernel::BinParameters parameters = parameters_;
  const std::uint32_t wanted = std::min(device_.traits.chunk_blocks, 64u);
  parameters.first = first;
  parameters.stride = std::max(1u, count / wanted + (count % wanted != 0));
  parameters.length = parameters.stride;
  parameters.end = first + count;
  parameters.block_count = count / parameters.stride + (count % parameters.stride != 0);
  return bin(parameters, order, lists);
}

bool Binner::bin(const kernel::BinParameters& parameters, const compute::buffer& order,
                 TileLists& lists) {
  Buffers& buffers = device_.buffers;
  const compute::buffer splats = buffers.get("splats", 0);
  const compute::buffer visible = buffers.get("visible", 0);
  const compute::buffer counts =
      buffers.get("tile counts", 4ull * parameters.block_count * parameters.tile_count);
  const compute::buffer lengths = buffers.get("tile lengths", 4ull * parameters.tile_count);
  const compute::buffer starts = buffers.get("tile starts", 4ull * parameters.tile_count);
  const std::uint64_t slots = std::uint64_t{parameters.block_count} * parameters.stride;
  const compute::buffer in_order =
      buffers.get("splats in order", ordered_ ? slots * splat_bytes(layout_) : 0);
  lists.segments = buffers.get("segments", segment_capacity_ * sizeof(kernel::Segment));
  lists.totals = buffers.get("totals", sizeof(kernel::BinTotals));

  Launch(device_, "bin", program_.create_kernel("bin_count"))
      .value(parameters)
      .arg(grids_)
      .arg(splats)
      .arg(order)
      .arg(visible)
      .arg(counts)
      .arg(in_order)
      .run_items(parameters.block_count);
  Launch(device_, "bin", program_.create_kernel("bin_scan_blocks"))
      .value(parameters)
      .arg(counts)
      .arg(lengths)
      .run_grid(parameters.tile_count, 1, 1);
  Launch(device_, "bin", program_.create_kernel("bin_scan_tiles"))
      .value(parameters)
      .arg(grids_)
      .arg(lengths)
      .arg(starts)
      .value(segment_capacity_)
      .arg(lists.segments)
      .arg(lists.totals)
      .run_items(1);
  kernel::BinTotals totals{};
  device_.queue.enqueue_read_buffer(lists.totals, 0, sizeof(totals), &totals);
  lists.entry_count = totals.entries_low | (std::uint64_t{totals.entries_high} << 32);
  lists.segment_count = totals.segment_count;
  lists.partial_count = totals.partial_count;
  lists.used_grids = totals.used_grids;
  if (lists.entry_count > entry_capacity_) return false;
  if (lists.entry_count == 0) return true;

  // Filled with what this pass needs, grown in few steps.
  lists.entries = buffers.get("tile entries", entry_capacity_ * entry_bytes_);
  Launch(device_, "bin", program_.create_kernel("bin_scatter"))
      .value(parameters)
      .arg(grids_)
      .arg(splats)
      .arg(order)
      .arg(visible)
      .arg(counts)
      .arg(in_order)
      .arg(starts)
      .arg(component_colors_)
      .arg(knots_)
      .arg(lists.entries)
      .run_items(parameters.block_count);
  return true;
}

}  // namespace splotchcl
