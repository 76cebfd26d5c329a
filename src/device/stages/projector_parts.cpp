// Large ordered frames on a processor: splats are put in parts of their sort keys while they are in
// its caches (kernels/project/key_parts.cl).
#include <algorithm>

#include "device/frame/block_counts.h"
#include "device/frame/chunks.h"
#include "device/opencl/launch.h"
#include "device/stages/part_placer.h"
#include "device/stages/projector.h"
#include "device/stages/projector_targets.h"
#include "scene/ceil_divide.h"

namespace splotchcl {
namespace {

// Some blocks, projected by one launch.
struct BlockRange {
  std::uint32_t component = 0;
  std::uint32_t first = 0, count = 0;  // of the component
  std::uint32_t first_piece = 0;
};

std::uint32_t blocks_of(const shared::ProjectParameters& of_component) {
  return ceil_divide(of_component.end_particle - of_component.first_particle,
                     of_component.block_particles);
}

std::vector<BlockRange> cut_in_ranges(const std::vector<shared::ProjectParameters>& components,
                                      std::uint32_t blocks_at_a_time, std::uint32_t piece_blocks) {
  std::vector<BlockRange> ranges;
  std::uint32_t piece = 0;
  for (std::uint32_t c = 0; c < components.size(); ++c) {
    const std::uint32_t blocks = blocks_of(components[c]);
    for (std::uint32_t first = 0; first < blocks; first += blocks_at_a_time) {
      const std::uint32_t count = std::min(blocks_at_a_time, blocks - first);
      ranges.push_back({c, first, count, piece});
      piece += ceil_divide(count, piece_blocks);
    }
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
  const std::vector<BlockRange> ranges =
      cut_in_ranges(all.components, at_a_time, traits.piece_blocks);
  const std::uint32_t pieces =
      ranges.back().first_piece + ceil_divide(ranges.back().count, traits.piece_blocks);
  const std::uint32_t stride = traits.project_block, slots = all.blocks * stride;
  const Filling filling = filling_of_slots();

  const auto counts = counts_of(all.blocks);
  const auto offsets = pool.upload(slots_apart(all.components, ranges, stride), "block offsets");
  KeyedSplats keyed;
  keyed.splats = splat_memory(slots, filling);
  keyed.keys = pool.get<std::uint32_t>(room_for_keys(slots), "sort keys", filling);
  keyed.key_ends = key_ends(slots, filling);
  PartPlacer placer(context_, *parts_, pieces, stride);
  const KeyedSplats apart = keyed_memory(at_a_time * stride);
  for (const BlockRange& range : ranges) {
    const shared::ProjectParameters part = part_of(all.components[range.component], range);
    launch(ProjectOutput::splats_and_keys, part, particles[range.component],
           part_of(all.left_out[range.component], range),
           {offsets, counts, apart.splats, apart.keys, apart.key_ends, unused_});
    placer.place(apart, counts, part.first_block, range.count, range.first_piece, keyed);
  }
  const std::vector<shared::BlockCounts> found = pool.download(counts, all.blocks);
  keyed.particles = sum_of(found);
  keyed.count = static_cast<std::uint32_t>(keyed.particles.visible);
  keyed.parts = placer.take_parts();
  if (keyed.particles.around > 0) {
    keyed.particles.chunks_around = chunks_around(all, found);
    gather_keys(keyed, slots);
  }
  return keyed;
}

// Clouds around the camera come among the splats, so these are sorted as if they lay in no parts.
void Projector::gather_keys(KeyedSplats& keyed, std::uint32_t slots) const {
  BufferPool& pool = context_.device.pool;
  const SplatParts parts = std::move(*keyed.parts);
  keyed.parts.reset();
  const std::size_t numbers = parts.keys.size() + 1;  // of a piece
  const std::vector<std::uint32_t> first_slots =
      pool.download(parts.first_slots, static_cast<std::size_t>(parts.first_slots.size()));
  std::vector<std::uint32_t> offsets;
  std::uint32_t before = 0;
  for (std::size_t piece = 0; piece < parts.piece_count; ++piece) {
    const std::uint32_t first = first_slots[piece * numbers];
    const std::uint32_t end = first_slots[piece * numbers + numbers - 1];
    const bool is_last = piece + 1 == parts.piece_count;
    const std::uint32_t end_of_room = is_last ? slots : first_slots[(piece + 1) * numbers];
    offsets.push_back(before);
    before += end - first;
    for (std::uint32_t slot = end;
         slot < end_of_room && keyed.free_slots.size() < keyed.particles.around; ++slot)
      keyed.free_slots.push_back(slot);
  }
  const std::uint64_t most = keyed.particles.visible + keyed.particles.around;
  const Buffer<std::uint32_t> keys = std::move(keyed.keys);
  keyed.keys = pool.get<std::uint32_t>(most, "sort keys");
  keyed.order = pool.get<std::uint32_t>(most, "order");
  const Program program = context_.device.programs.get(context_.specialization.key_parts());
  Launch(context_.device, "project", program.create_kernel("gather_keys"))
      .value(static_cast<cl_uint>(parts.keys.size()))
      .arg(parts.first_slots)
      .arg(pool.upload(offsets, "offsets of pieces"))
      .arg(keys)
      .arg(keyed.keys)
      .arg(keyed.order)
      .run_items(parts.piece_count);
}

}  // namespace splotchcl
