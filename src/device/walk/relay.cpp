#include "device/walk/relay.h"

#include <algorithm>
#include <utility>

#include "device/opencl/launch.h"

namespace splotchcl {
namespace {

// What of the sorted splats is left from place `first` on, in its order, to the first slots of
// `keyed`, with keys of 0.
void carry_splats(const StageContext& context, const SortedSplats& sorted, std::uint32_t first,
                  const KeyedSplats& keyed) {
  DeviceContext& device = context.device;
  const Program program = device.programs.get(program_source("kernels/sort/carry.cl"));
  Launch(device, "sort", program.create_kernel("carry_splats"))
      .value(static_cast<cl_uint>(first))
      .value(static_cast<cl_uint>(context.variant.splat_bytes() / sizeof(cl_uint)))
      .value(static_cast<cl_uint>(keyed.key_ends.size() > 0))
      .arg(sorted.order)
      .arg(sorted.splats)
      .arg(keyed.splats)
      .arg(keyed.keys)
      .arg(keyed.key_ends)
      .arg(keyed.order)
      .run_items(sorted.count - first);
}

}  // namespace

std::vector<std::uint64_t> sort_keys_up_to(const StageContext& context, const KeyedSplats& keyed,
                                           std::uint64_t last) {
  BufferPool& pool = context.device.pool;
  const auto upper = pool.map_to_read(keyed.keys, keyed.count);
  const bool has_ends = keyed.key_ends.size() > 0;
  const auto slots = pool.map_to_read(keyed.order, has_ends ? keyed.count : 0);
  const auto ends = pool.map_to_read(keyed.key_ends, keyed.key_ends.size());
  std::vector<std::uint64_t> keys;
  for (std::size_t i = 0; i < upper.size(); ++i) {
    if (upper.data()[i] > last >> 16) continue;
    const std::uint64_t end = has_ends ? ends.data()[slots.data()[i]] : 0;
    const std::uint64_t key = std::uint64_t{upper.data()[i]} << 16 | end;
    if (key <= last) keys.push_back(key);
  }
  return keys;
}

void Relay::pass_splats(const SortedSplats& sorted, std::uint32_t count) {
  splats_.clear();
  if (count > 0) {
    const KeyedSplats last = projector_.keyed_memory(count);
    carry_splats(context_, sorted, sorted.count - count, last);
    splats_ = context_.device.pool.download(last.splats, count * context_.variant.splat_bytes());
  }
  if (!is_last_rank()) send_splats(ranks_.rank() + 1);
}

void Relay::send_splats(int to) const {
  if (!splats_.empty()) ranks_.all.send(splats_.data(), splats_.size(), to);
  ranks_.work.sent_bytes += splats_.size();
}

void Relay::pass_round(const SplatLight& light) {
  if (ranks_.size() == 1 || !is_last_rank()) return;
  send_splats(0);
  transfer_.send(light, 0);
}

void Relay::take_splats(std::size_t round, const Buffer<std::byte>& splats, std::uint32_t count) {
  if (count == 0) return;
  if (has_other_before(round)) {
    splats_.resize(count * context_.variant.splat_bytes());
    ranks_.all.receive(splats_.data(), splats_.size(), rank_before());
  }
  context_.device.pool.write(splats, 0, splats_.data(), splats_.size());
}

SplatLight Relay::bring_home(SplatLight light) const {
  if (ranks_.size() == 1) return light;
  if (is_last_rank()) transfer_.send(light, 0);
  return is_first_rank() ? receive_light(std::move(light.slab)) : std::move(light);
}

std::vector<TileBand> relay_bands(const PictureLayout& layout, int ranks) {
  const shared::Grid& grid = layout.grids.front();
  const auto across = static_cast<std::uint32_t>(grid.tiles_x);
  const auto rows = static_cast<std::uint32_t>(grid.tiles_y);
  const std::uint32_t bands = std::min(rows, 2 * static_cast<std::uint32_t>(ranks));
  std::vector<TileBand> cut;
  for (std::uint32_t band = 0; band < bands; ++band) {
    const auto row_of = [&](std::uint32_t border) {
      return static_cast<std::uint32_t>(std::uint64_t{rows} * border / bands);
    };
    cut.push_back({row_of(band) * across, row_of(band + 1) * across});
  }
  return cut;
}

std::vector<TileBand> parts_in(const TileBand& whole, const std::vector<TileBand>& bands) {
  std::vector<TileBand> parts;
  for (const TileBand& band : bands) {
    const TileBand part = {std::max(whole.first, band.first), std::min(whole.end, band.end)};
    if (part.first < part.end) parts.push_back(part);
  }
  return parts;
}

}  // namespace splotchcl
