// Large ordered frames on a processor: splats are put in parts of their sort keys while they are in
// its caches (kernels/project/key_parts.cl).
#include <algorithm>

#include "device/frame/block_counts.h"
#include "device/frame/chunks.h"
#include "device/stages/part_placer.h"
#include "device/stages/project_parameters.h"
#include "device/stages/projector.h"
#include "device/stages/projector_targets.h"
#include "scene/ceil_divide.h"

namespace splotchcl {
namespace {

// Some blocks, projected by one launch.
struct BlockRange {
  std::uint32_t component = 0;
  std::uint32_t first = 0, count = 0;  // of the component
};

std::vector<BlockRange> cut_in_ranges(const std::vector<shared::ProjectParameters>& components,
                                      std::uint32_t blocks_at_a_time) {
  std::vector<BlockRange> ranges;
  for (std::uint32_t c = 0; c < components.size(); ++c) {
    const std::uint32_t blocks = block_count(components[c]);
    for (std::uint32_t first = 0; first < blocks; first += blocks_at_a_time)
      ranges.push_back({c, first, std::min(blocks_at_a_time, blocks - first)});
  }
  return ranges;
}

shared::ProjectParameters part_of(const shared::ProjectParameters& all, const BlockRange& range) {
  shared::ProjectParameters part = all;
  part.first_block += range.first;
  part.first_particle += range.first * all.block_particles;
  part.end_particle =
      std::min(all.end_particle, part.first_particle + range.count * all.block_particles);
  return part;
}

std::vector<std::uint32_t> part_of(const std::vector<std::uint32_t>& left_out,
                                   const BlockRange& range) {
  if (left_out.empty()) return {};
  const auto first = left_out.begin() + range.first;
  return {first, first + range.count};
}

// Of every block, in the memory of those that are projected with it.
std::vector<std::uint32_t> slots_apart(const std::vector<shared::ProjectParameters>& components,
                                       const std::vector<BlockRange>& ranges,
                                       std::uint32_t stride) {
  std::vector<std::uint32_t> slots;
  for (const BlockRange& range : ranges) {
    slots.resize(components[range.component].first_block + range.first);
    for (std::uint32_t block = 0; block < range.count; ++block)
      slots.push_back(block * stride);
  }
  return slots;
}

}  // namespace

// Lists have their memory when all has been sorted.
std::uint64_t Projector::room_for_keys(std::uint32_t slots) const {
  const std::uint64_t entries =
      entry_capacity(context_.plan, context_.device.traits) + ENTRIES_BEHIND;
  const std::uint64_t bytes = entries * context_.specialization.tile_splat_bytes();
  return std::max<std::uint64_t>(slots, ceil_divide(bytes, sizeof(std::uint32_t)));
}

// Blocks are projected some at a time into memory that caches keep, from which their splats go to
// where they stay.
KeyedSplats Projector::project_all_in_parts(const AllParticles& all,
                                            const std::vector<ParticleBuffers>& particles) const {
  BufferPool& pool = context_.device.pool;
  const DeviceTraits& traits = context_.device.traits;
  const std::uint32_t at_a_time = std::min(blocks_apart(traits), all.blocks);
  const std::vector<BlockRange> ranges = cut_in_ranges(all.components, at_a_time);
  const std::uint32_t stride = traits.project_block, slots = all.blocks * stride;
  const Filling filling = filling_of_slots();

  const auto counts = counts_of(all.blocks);
  const auto offsets = pool.upload(slots_apart(all.components, ranges, stride), "block offsets");
  KeyedSplats keyed;
  keyed.splats = splat_memory(slots, filling);
  keyed.keys = pool.get<std::uint32_t>(room_for_keys(slots), "sort keys", filling);
  keyed.key_ends = key_ends(slots, filling);
  PartPlacer placer(context_, *parts_, all.blocks, stride);
  const KeyedSplats apart = keyed_memory(at_a_time * stride);
  for (const BlockRange& range : ranges) {
    const shared::ProjectParameters part = part_of(all.components[range.component], range);
    launch(ProjectOutput::splats_and_keys, part, particles[range.component],
           part_of(all.left_out[range.component], range),
           {offsets, counts, apart.splats, apart.keys, apart.key_ends, unused_});
    placer.place(apart, counts, part.first_block, range.count, keyed);
  }
  const std::vector<shared::BlockCounts> found = pool.download(counts, all.blocks);
  keyed.particles = sum_of(found);
  keyed.count = static_cast<std::uint32_t>(keyed.particles.visible);
  if (keyed.particles.around == 0) {
    keyed.parts = placer.take_parts();
    return keyed;
  }
  // Clouds around the camera come among the splats, so these are sorted as if they lay in no parts.
  keyed.particles.chunks_around = chunks_around(all, found);
  keyed.free_slots = free_slots(found, stride, keyed.particles.around);
  const Buffer<std::uint32_t> keys = std::move(keyed.keys);
  put_keys_together(keys, counts, all.blocks, stride, keyed);
  return keyed;
}

}  // namespace splotchcl
