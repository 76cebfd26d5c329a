#include "device/stages/projector.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "device/frame/block_boxes.h"
#include "device/frame/particle_store.h"
#include "device/frame/records.h"
#include "device/frame/shared.h"
#include "device/stages/project_parameters.h"
#include "device/stages/stage_programs.h"
#include "parallel/for_blocks.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

static_assert(width_octaves == WIDTH_OCTAVES);

ParticleCounts sum_of(const std::vector<shared::BlockCounts>& blocks) {
  ParticleCounts sum;
  for (const shared::BlockCounts& block : blocks) {
    sum.visible += block.visible;
    sum.bad += block.bad;
    sum.too_sharp += block.too_sharp;
    sum.around += block.around;
  }
  return sum;
}

std::vector<std::uint32_t> blocks_around(const shared::BlockCounts* first, std::size_t count) {
  std::vector<std::uint32_t> blocks;
  for (std::uint32_t b = 0; b < count; ++b) {
    if (first[b].around > 0) blocks.push_back(b);
  }
  return blocks;
}

// Of blocks whose particles have a slot each, and of what follows the last.
std::vector<std::uint32_t> first_slots(std::uint32_t blocks, std::uint32_t stride) {
  std::vector<std::uint32_t> first(std::size_t{blocks} + 1);
  for (std::uint32_t b = 0; b <= blocks; ++b)
    first[b] = b * stride;
  return first;
}

// Of the same without gaps between the splats, and how many these are.
std::vector<std::uint32_t> first_splats(const std::vector<shared::BlockCounts>& blocks) {
  std::vector<std::uint32_t> first = {0};
  for (const shared::BlockCounts& block : blocks)
    first.push_back(first.back() + block.visible);
  return first;
}

// The first `wanted` slots that their blocks' splats leave. Particles around the camera leave as
// many as they are.
std::vector<std::uint32_t> free_slots(const std::vector<shared::BlockCounts>& blocks,
                                      std::uint32_t stride, std::uint64_t wanted) {
  std::vector<std::uint32_t> slots;
  for (std::uint32_t b = 0; b < blocks.size(); ++b) {
    for (std::uint32_t k = blocks[b].visible; k < stride && slots.size() < wanted; ++k)
      slots.push_back(b * stride + k);
  }
  return slots;
}

std::uint32_t count_left_out(const std::vector<std::uint32_t>& blocks) {
  return static_cast<std::uint32_t>(
      std::count_if(blocks.begin(), blocks.end(), [](std::uint32_t block) { return block != 0; }));
}

void take_window(const KeyWindow& window, shared::ProjectParameters<float>& parameters) {
  parameters.launch.window_first = wide(window.first);
  parameters.launch.window_end = wide(window.end);
}

// A group has an item for each particle of a block, and boxes around blocks are made beforehand.
void check_blocks_of_groups(const DeviceTraits& traits) {
  if (traits.project_block == GROUP_ITEMS) return;
  throw DeviceError(
      "found blocks of " + std::to_string(traits.project_block) +
      " particles in the shape for GPUs, expected as many as its groups have items, " +
      std::to_string(GROUP_ITEMS) + "; leave their size to DeviceTraits");
}

}  // namespace

// Where a launch that counts keys writes.
struct Projector::KeyTargets {
  const Buffer<std::uint32_t>& counts;
  const Buffer<shared::KeyBins>& bins;  // of each block
};

// Where a launch writes.
struct Projector::Targets {
  const Buffer<std::uint32_t>& offsets;  // read: of each block's first splat
  const Buffer<shared::BlockCounts>& counts;
  const Buffer<std::byte>& splats;
  const Buffer<std::uint32_t>& keys;
  const Buffer<std::uint16_t>& key_ends;
  // Of splats that are binned as they come.
  const SplatBlocks* blocks = nullptr;
  const KeyTargets* key_counts = nullptr;  // where keys are counted
};

// Of a launch for each component.
struct Projector::AllParticles {
  std::vector<shared::ProjectParameters<float>> components;
  std::vector<std::vector<std::uint32_t>> left_out;
  std::uint32_t blocks = 0, blocks_left_out = 0;
};

Projector::Projector(const StageContext& context)
    : context_(context),
      width_needs_(upload_needs()),
      unused_(context.device.pool.get<std::uint32_t>(0, "unused")),
      unused_ends_(context.device.pool.get<std::uint16_t>(0, "unused")) {
  if (!has_rows()) check_blocks_of_groups(context.device.traits);
  // Asked for, so that they are compiled with those of other stages.
  ProgramCache& programs = context.device.programs;
  const bool sorts = context.plan.needs_sort();
  if (sorts || !has_rows()) programs.get(program_source("kernels/project/compact.cl"));
  programs.get(project_program(context.variant,
                               sorts ? ProjectOutput::splats_and_keys : ProjectOutput::splats));
}

Buffer<shared::WidthNeeds> Projector::upload_needs() const {
  shared::WidthNeeds needs{};
  for (std::size_t octave = 0; octave < context_.plan.needs.widths.size(); ++octave) {
    const WidthNeed& need = context_.plan.needs.widths[octave];
    needs.light[octave] = static_cast<float>(need.light);
    needs.farther[octave] = static_cast<float>(need.farther);
  }
  return context_.device.pool.upload(std::vector{needs}, "needs of widths");
}

Buffer<std::byte> Projector::splat_memory(std::uint64_t splats, Filling filling) const {
  return context_.device.pool.get<std::byte>(splats * context_.variant.splat_bytes(), "splat",
                                             filling);
}

std::vector<std::uint32_t> Projector::left_out_blocks(
    const shared::ProjectParameters<float>& parameters, const ParticleBuffers& particles) const {
  if (particles.boxes == nullptr) return {};
  const DrawnComponent& component = context_.frame.components[parameters.component];
  const ViewBounds bounds(context_.frame, component, parameters);
  const auto first = static_cast<std::size_t>((particles.first + parameters.launch.first_particle) /
                                              parameters.launch.block_particles);
  std::vector<std::uint32_t> blocks(block_count(parameters));
  // Of a GPU's small blocks there are very many.
  constexpr std::size_t blocks_of_thread = 4096;
  for_blocks(blocks.size(), blocks_of_thread, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const shared::BlockBox& box = particles.boxes->at(first + b);
      if (bounds.leave_out(box)) blocks[b] = box.bad + 1;
    }
  });
  return count_left_out(blocks) > 0 ? blocks : std::vector<std::uint32_t>();
}

void Projector::launch(ProjectOutput output, shared::ProjectParameters<float> parameters,
                       const ParticleBuffers& particles, const std::vector<std::uint32_t>& left_out,
                       const Targets& targets) const {
  DeviceContext& device = context_.device;
  parameters.launch.leaves_out_blocks = !left_out.empty();
  const Buffer<std::uint32_t> left_out_buffer = device.pool.upload(left_out, "blocks out of view");
  const Program program = device.programs.get(project_program(context_.variant, output));
  Launch launch(device, "project", program.create_kernel("project"));
  pass_parameters(launch, context_, parameters)
      .value(make_sharp_parameters(context_, context_.frame.components[parameters.component]));
  pass_columns(launch, particles)
      .arg(targets.offsets)
      .arg(targets.counts)
      .arg(targets.splats)
      .arg(targets.keys)
      .arg(targets.key_ends)
      .arg(width_needs_)
      .arg(left_out_buffer)
      .arg(context_.colors.components)
      .arg(context_.colors.knots)
      .arg(targets.key_counts ? targets.key_counts->counts : unused_);
  if (targets.key_counts)
    launch.arg(targets.key_counts->bins);
  else
    launch.arg(unused_);
  launch.arg(context_.grids)
      .arg(targets.blocks ? targets.blocks->tile_counts : unused_)
      .arg(targets.blocks ? targets.blocks->tiles : unused_);
  if (has_rows()) {
    launch.run_pieces(block_count(parameters));
  } else {
    launch.run_groups(block_count(parameters), GROUP_ITEMS);
  }
}

// A group for each block, to which one item of a processor is enough.
void Projector::run_by_blocks(Launch& launch, std::size_t blocks) const {
  launch.run_groups(blocks, has_rows() ? 1 : GROUP_ITEMS);
}

std::uint32_t Projector::stride_of(const shared::ProjectParameters<float>& parameters) const {
  return parameters.launch.block_particles *
         static_cast<std::uint32_t>(context_.plan.splats_per_particle);
}

SplatBlocks Projector::project(const ParticleChunk& chunk, const ParticleBuffers& particles) const {
  BufferPool& pool = context_.device.pool;
  const shared::ProjectParameters<float> parameters =
      make_project_parameters(context_, chunk, particles);
  SplatBlocks blocks;
  blocks.stride = stride_of(parameters);
  blocks.block_count = block_count(parameters);
  blocks.counts = pool.get<shared::BlockCounts>(blocks.block_count, "block counts");
  const std::uint64_t slots = std::uint64_t{blocks.block_count} * blocks.stride;
  blocks.splats = splat_memory(slots);
  const bool lists_tiles = has_rows() && !context_.variant.has_own_tiles();
  blocks.tiles = pool.get<std::uint32_t>(lists_tiles ? slots : 0, "tiles of splats");
  blocks.tile_counts = pool.get<std::uint32_t>(
      has_rows() ? counted_tiles(blocks.block_count, context_.layout) : 0, "tile counts");
  const std::vector<std::uint32_t> left_out = left_out_blocks(parameters, particles);
  blocks.left_out = count_left_out(left_out);
  launch(ProjectOutput::splats, parameters, particles, left_out,
         {pool.upload(first_slots(blocks.block_count, blocks.stride), "block offsets"),
          blocks.counts, blocks.splats, unused_, unused_ends_, &blocks});
  if (!has_rows()) list_slots(blocks);
  return blocks;
}

void Projector::list_slots(SplatBlocks& blocks) const {
  BufferPool& pool = context_.device.pool;
  const std::vector<std::uint32_t> first =
      first_splats(pool.download(blocks.counts, blocks.block_count));
  blocks.visible = first.back();
  blocks.order = pool.get<std::uint32_t>(blocks.visible, "slots of splats");
  list_slots(blocks.stride, blocks.counts, first, {unused_, unused_, false}, blocks.order);
}

// Where the splats of all blocks lie, of which each one's first is number first[b] of them.
void Projector::list_slots(std::uint32_t stride, const Buffer<shared::BlockCounts>& counts,
                           const std::vector<std::uint32_t>& first, const MovedKeys& keys,
                           const Buffer<std::uint32_t>& order) const {
  Launch launch(context_.device, "project",
                context_.device.programs.get(program_source("kernels/project/compact.cl"))
                    .create_kernel("list_slots"));
  launch.value(stride)
      .value(static_cast<cl_uint>(keys.are_moved))
      .arg(counts)
      .arg(context_.device.pool.upload(first, "block offsets"))
      .arg(keys.from)
      .arg(keys.to)
      .arg(order);
  run_by_blocks(launch, first.size() - 1);
}

ParticleCounts Projector::count(const SplatBlocks& blocks, const ParticleChunk& chunk) const {
  const std::vector<shared::BlockCounts> found =
      context_.device.pool.download(blocks.counts, blocks.block_count);
  ParticleCounts sum = sum_of(found);
  if (sum.around == 0) return sum;
  sum.chunks_around = {ChunkBlocks{chunk, blocks_around(found.data(), found.size())}};
  return sum;
}

Projector::AllParticles Projector::all_of(const std::vector<ParticleBuffers>& particles) const {
  AllParticles all;
  for (std::uint32_t c = 0; c < context_.frame.components.size(); ++c) {
    const std::size_t count = context_.frame.components[c].particles.count;
    all.components.push_back(make_project_parameters(context_, {c, 0, count}, particles[c]));
    all.components.back().launch.first_block = all.blocks;
    all.blocks += block_count(all.components.back());
    all.left_out.push_back(left_out_blocks(all.components.back(), particles[c]));
    all.blocks_left_out += count_left_out(all.left_out.back());
  }
  return all;
}

// In the chunks that particles are listed in.
std::vector<ChunkBlocks> Projector::chunks_around(
    const AllParticles& all, const std::vector<shared::BlockCounts>& found) const {
  const DeviceTraits& traits = context_.device.traits;
  std::vector<ChunkBlocks> around;
  for (ChunkBlocks& chunk : all_blocks(particle_chunks(context_.frame, traits), traits)) {
    const std::uint64_t first = all.components[chunk.chunk.component].launch.first_block +
                                chunk.chunk.first / traits.project_block;
    chunk.blocks = blocks_around(found.data() + first, chunk.blocks.size());
    if (!chunk.blocks.empty()) around.push_back(std::move(chunk));
  }
  return around;
}

// Large pages have memory for all of the room as soon as any of it is written to, and are made in
// half the time of small ones.
Filling Projector::filling_of_slots() const {
  constexpr double mostly = 0.7;
  return context_.plan.visible_part >= mostly ? Filling::whole : Filling::in_parts;
}

// Only keys are moved. A processor has no memory for slots that nothing is written to, where these
// are many.
KeyedSplats Projector::project_all(const std::vector<ParticleBuffers>& particles) const {
  const AllParticles all = all_of(particles);
  if (all.blocks == 0) return {};
  const Filling filling = filling_of_slots();
  BufferPool& pool = context_.device.pool;
  const std::uint32_t stride = stride_of(all.components.front());
  const std::uint32_t slots = all.blocks * stride;
  const auto counts = pool.get<shared::BlockCounts>(all.blocks, "block counts");
  const auto keys = pool.get<std::uint32_t>(slots, "sort keys of blocks", filling);
  const auto offsets = pool.upload(first_slots(all.blocks, stride), "block offsets");
  KeyedSplats keyed;
  keyed.splats = splat_memory(slots, filling);
  keyed.key_ends = key_ends(slots, filling);
  for (std::size_t c = 0; c < all.components.size(); ++c) {
    launch(ProjectOutput::splats_and_keys, all.components[c], particles[c], all.left_out[c],
           {offsets, counts, keyed.splats, keys, keyed.key_ends});
  }
  const std::vector<shared::BlockCounts> found = pool.download(counts, all.blocks);
  keyed.particles = sum_of(found);
  keyed.count = static_cast<std::uint32_t>(keyed.particles.visible);
  keyed.left_out = all.blocks_left_out;
  keyed.free_slots = free_slots(found, stride, keyed.particles.around);
  if (keyed.particles.around > 0) keyed.particles.chunks_around = chunks_around(all, found);
  put_keys_together(keys, counts, found, stride, keyed);
  return keyed;
}

// Of keys that lie block by block, those of splats, and where these lie; with room for clouds
// around the camera.
void Projector::put_keys_together(const Buffer<std::uint32_t>& keys,
                                  const Buffer<shared::BlockCounts>& counts,
                                  const std::vector<shared::BlockCounts>& found,
                                  std::uint32_t stride, KeyedSplats& keyed) const {
  BufferPool& pool = context_.device.pool;
  const std::uint64_t most = keyed.particles.visible + keyed.particles.around;
  // What sorting alone needs comes back as one: lists find their memory there.
  auto [sort_keys, scratch] = pool.get_two<std::uint32_t>(most, "sort keys");
  keyed.keys = std::move(sort_keys);
  keyed.scratch = std::move(scratch);
  keyed.order = pool.get<std::uint32_t>(most, "order");
  list_slots(stride, counts, first_splats(found), {keys, keyed.keys, true}, keyed.order);
}

KeyedSplats Projector::keyed_memory(std::uint32_t count) const {
  BufferPool& pool = context_.device.pool;
  KeyedSplats keyed;
  keyed.count = count;
  keyed.splats = splat_memory(count);
  keyed.keys = pool.get<std::uint32_t>(count, "sort keys");
  keyed.key_ends = key_ends(count);
  keyed.order = pool.get<std::uint32_t>(count, "order");
  return keyed;
}

Buffer<std::uint16_t> Projector::key_ends(std::uint32_t slots, Filling filling) const {
  const std::uint32_t count = context_.frame.sort.by == SortOrder::By::depth ? slots : 0;
  return context_.device.pool.get<std::uint16_t>(count, "ends of sort keys", filling);
}

ChunkKeys Projector::count_keys(const ParticleChunk& chunk, const ParticleBuffers& particles,
                                const KeyWindow& window, int shift,
                                const Buffer<std::uint32_t>& key_counts) const {
  BufferPool& pool = context_.device.pool;
  shared::ProjectParameters<float> parameters = make_project_parameters(context_, chunk, particles);
  take_window(window, parameters);
  parameters.launch.bin_shift = shift;
  const std::uint32_t blocks = block_count(parameters);
  const auto counts = pool.get<shared::BlockCounts>(blocks, "block counts");
  const auto offsets = pool.upload(std::vector<std::uint32_t>(blocks + 1), "block offsets");
  const auto bins = pool.get<shared::KeyBins>(blocks, "bins of keys");
  const KeyTargets keys = {key_counts, bins};
  const std::vector<std::uint32_t> left_out = left_out_blocks(parameters, particles);
  Targets targets = {offsets, counts, splat_memory(0), unused_, unused_ends_};
  targets.key_counts = &keys;
  launch(ProjectOutput::key_counts, parameters, particles, left_out, targets);
  return {sum_of(pool.download(counts, blocks)), pool.download(bins, blocks),
          count_left_out(left_out)};
}

// A window has a part of each block's splats. Where they go is known when all are projected, and
// to move them is cheaper than to project the particles twice.
std::uint32_t Projector::project_window(const ParticleChunk& chunk,
                                        const ParticleBuffers& particles, const KeyWindow& window,
                                        const std::vector<std::uint32_t>& without,
                                        const KeyedSplats& keyed, std::uint32_t first_slot) const {
  BufferPool& pool = context_.device.pool;
  shared::ProjectParameters<float> parameters = make_project_parameters(context_, chunk, particles);
  take_window(window, parameters);
  const std::uint32_t blocks = block_count(parameters), stride = stride_of(parameters);
  const auto counts = pool.get<shared::BlockCounts>(blocks, "block counts");
  const KeyedSplats apart = keyed_memory(blocks * stride);
  launch(ProjectOutput::splats_and_keys, parameters, particles, without,
         {pool.upload(first_slots(blocks, stride), "block offsets"), counts, apart.splats,
          apart.keys, apart.key_ends});
  const std::vector<std::uint32_t> first = first_splats(pool.download(counts, blocks));
  Launch compact(context_.device, "project",
                 context_.device.programs.get(program_source("kernels/project/compact.cl"))
                     .create_kernel("compact"));
  compact.value(first_slot)
      .value(stride)
      .value(static_cast<cl_uint>(context_.variant.splat_bytes() / sizeof(cl_uint)))
      .value(static_cast<cl_uint>(keyed.key_ends.size() > 0))
      .arg(counts)
      .arg(pool.upload(first, "block offsets"))
      .arg(apart.splats)
      .arg(apart.keys)
      .arg(apart.key_ends)
      .arg(keyed.splats)
      .arg(keyed.keys)
      .arg(keyed.key_ends)
      .arg(keyed.order);
  run_by_blocks(compact, blocks);
  return first.back();
}

}  // namespace splotchcl
