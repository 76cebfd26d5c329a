#include "device/walk/splat_slices.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "device/frame/picture_layout.h"
#include "device/frame/stage_context.h"
#include "device/ranks/rank_share.h"
#include "device/ranks/transfers.h"
#include "device/stages/project_parameters.h"
#include "ranks/exchange.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

bool are_in(const shared::KeyBins& bins, const KeyWindow& window) {
  return bins.least <= bins.most && bins.most >= window.first >> shift_of_all_keys &&
         bins.least <= (window.end - 1) >> shift_of_all_keys;
}

}  // namespace

std::uint64_t splat_capacity(const StageContext& context) {
  return splat_capacity(context.plan, context.variant, context.layout, context.device.traits,
                        context.device.memory.total);
}

KeyedSplats project_whole(const StageContext& context, const Projector& projector,
                          ParticleStore& particles) {
  std::vector<ParticleBuffers> buffers;
  for (std::uint32_t c = 0; c < context.frame.components.size(); ++c) {
    const ParticleChunk all = {c, 0, context.frame.components[c].particles.count};
    buffers.push_back(particles_in_view(context, particles, all));
  }
  return projector.project_all(buffers);
}

SplatSlices::SplatSlices(const StageContext& context, const Projector& projector,
                         ParticleStore& particles, FrameRanks& ranks)
    : context_(context),
      projector_(projector),
      particles_(particles),
      ranks_(ranks),
      chunks_(particles_of_rank(context.frame, context.device.traits, ranks.rank(), ranks.size())),
      bins_(chunks_.size()),
      chunks_of_ranks_(gather_values(ranks.all, chunks_.size())) {
  first_chunk_ = std::accumulate(chunks_of_ranks_.begin(), chunks_of_ranks_.begin() + ranks.rank(),
                                 std::uint64_t{0});
  for (const ParticleChunk& chunk : chunks_)
    ranks.work.particles += chunk.count();
}

void SplatSlices::find() {
  if (ranks_.size() == 1 && has_room_for_all()) {
    find_whole();
  } else {
    count_keys();
  }
}

bool SplatSlices::has_room_for_all() const {
  for (const DrawnComponent& component : context_.frame.components) {
    if (!particles_.are_whole(component.particles)) return false;
  }
  return splat_slots(context_.frame, context_.plan, context_.device.traits) <=
         splat_capacity(context_);
}

void SplatSlices::find_whole() {
  whole_ = project_whole(context_, projector_, particles_);
  counts_ = whole_.particles;
  own_around_ = counts_.around;
  left_out_ = whole_.left_out;
  slices_ = {{{0, 0}, {end_of_keys, 0}, 0, counts_.visible}};
}

void SplatSlices::count_keys() {
  const CountedKeys counted = count_everywhere({}, shift_of_all_keys);
  own_around_ = counts_.around;
  if (own_around_ > 0) counts_.chunks_around = all_blocks(chunks_, context_.device.traits);
  add_up(ranks_.all,
         {&counts_.visible, &counts_.bad, &counts_.too_sharp, &counts_.around, &left_out_});
  if (counts_.too_sharp > 0) return;
  capacity_ = smallest_of(ranks_.all, splat_capacity(context_));
  slices_ = cut_in_slices(
      counted, static_cast<std::size_t>(ranks_.size()), capacity_,
      [this](const KeyWindow& window, int shift) { return count_everywhere(window, shift); },
      [this](const KeyWindow& window) { return count_chunks(window); });
}

std::uint64_t SplatSlices::most_splats_of(std::size_t chunk) const {
  return std::uint64_t{chunks_[chunk].count()} *
         static_cast<std::uint64_t>(context_.plan.splats_per_particle);
}

bool SplatSlices::has_keys_in(std::size_t chunk, const KeyWindow& window) const {
  return std::any_of(bins_[chunk].begin(), bins_[chunk].end(),
                     [&](const shared::KeyBins& block) { return are_in(block, window); });
}

Buffer<std::uint32_t> SplatSlices::empty_bins() const {
  return context_.device.pool.upload(std::vector<std::uint32_t>(KEY_BINS), "counts of keys");
}

// So many chunks at a time as 32 bits allow.
CountedKeys SplatSlices::count_here(const KeyWindow& window, int shift) {
  const bool is_first = window.first == 0 && window.end == end_of_keys;
  CountedKeys counted{window, shift, std::vector<std::uint64_t>(KEY_BINS)};
  Buffer<std::uint32_t> bins = empty_bins();
  std::uint64_t counted_splats = 0;
  const auto take = [&] {
    const std::vector<std::uint32_t> found = context_.device.pool.download(bins, KEY_BINS);
    for (std::size_t bin = 0; bin < found.size(); ++bin)
      counted.bins[bin] += found[bin];
  };
  for (std::size_t c = 0; c < chunks_.size(); ++c) {
    if (!is_first && !has_keys_in(c, window)) continue;
    if (counted_splats + most_splats_of(c) > std::numeric_limits<std::uint32_t>::max()) {
      take();
      bins = empty_bins();
      counted_splats = 0;
    }
    counted_splats += most_splats_of(c);
    const ChunkKeys keys = projector_.count_keys(chunks_[c], particles_of(c), window, shift, bins);
    if (!is_first) continue;
    bins_[c] = keys.bins;
    left_out_ += keys.left_out;
    counts_ += keys.particles;
  }
  take();
  return counted;
}

CountedKeys SplatSlices::count_everywhere(const KeyWindow& window, int shift) {
  CountedKeys counted = count_here(window, shift);
  ranks_.all.add_up(counted.bins);
  return counted;
}

std::vector<std::uint64_t> SplatSlices::count_chunks(const KeyWindow& window) {
  std::vector<std::uint64_t> counts(static_cast<std::size_t>(
      std::accumulate(chunks_of_ranks_.begin(), chunks_of_ranks_.end(), std::uint64_t{0})));
  for (std::size_t c = 0; c < chunks_.size(); ++c) {
    if (!has_keys_in(c, window)) continue;
    const Buffer<std::uint32_t> bins = empty_bins();
    projector_.count_keys(chunks_[c], particles_of(c), window, shift_of_all_keys, bins);
    const std::vector<std::uint32_t> found = context_.device.pool.download(bins, KEY_BINS);
    counts[static_cast<std::size_t>(first_chunk_) + c] =
        std::accumulate(found.begin(), found.end(), std::uint64_t{0});
  }
  ranks_.all.add_up(counts);
  return counts;
}

bool SplatSlices::has_room_for_copies() const {
  return rounds() == 1 && std::all_of(slices_.begin(), slices_.end(), [&](const KeySlice& slice) {
           return 2 * slice.splats <= capacity_;
         });
}

std::size_t SplatSlices::number_of_slice(std::size_t round) const {
  return round * static_cast<std::size_t>(ranks_.size()) + static_cast<std::size_t>(ranks_.rank());
}

KeyedSplats SplatSlices::take(std::size_t round, std::uint32_t carried, std::uint32_t more) {
  const KeySlice& own = slices_[number_of_slice(round)];
  if (is_whole()) return std::move(whole_);
  KeyedSplats keyed = memory_for(own, carried, more);
  if (ranks_.size() == 1) {
    project(own, keyed, carried);
  } else {
    exchange(round, keyed, carried);
  }
  return keyed;
}

// Those that are carried come first, in an order that is theirs already.
KeyedSplats SplatSlices::memory_for(const KeySlice& own, std::uint32_t carried,
                                    std::uint32_t more) const {
  const std::uint32_t count = carried + static_cast<std::uint32_t>(own.splats);
  KeyedSplats keyed = projector_.keyed_memory(count + more);
  keyed.count = count;
  BufferPool& pool = context_.device.pool;
  std::vector<std::uint32_t> order(carried);
  std::iota(order.begin(), order.end(), 0u);
  pool.write(keyed.order, 0, order.data(), carried);
  pool.write(keyed.keys, 0, std::vector<std::uint32_t>(carried).data(), carried);
  if (keyed.key_ends.size() > 0)
    pool.write(keyed.key_ends, 0, std::vector<std::uint16_t>(carried).data(), carried);
  return keyed;
}

std::uint32_t SplatSlices::project(std::size_t chunk, const KeyWindow& window,
                                   const KeyedSplats& keyed, std::uint32_t slot) const {
  // Of each block 1 where it has no keys in the window.
  std::vector<std::uint32_t> without;
  for (const shared::KeyBins& block : bins_[chunk])
    without.push_back(are_in(block, window) ? 0 : 1);
  return projector_.project_window(chunks_[chunk], particles_of(chunk), window, without, keyed,
                                   slot);
}

void SplatSlices::project(const KeySlice& own, KeyedSplats& keyed, std::uint32_t first_slot) const {
  std::uint32_t slot = first_slot;
  for (std::size_t c = 0; c < chunks_.size(); ++c) {
    const KeyWindow window = window_of_chunk(own, c);
    if (window.first < window.end && has_keys_in(c, window))
      slot += project(c, window, keyed, slot);
  }
  check(slot - first_slot, own.splats);
}

// One of this rank's chunks, projected: a packet for each rank.
std::vector<Communicator::Bytes> SplatSlices::share_out(std::size_t round, std::size_t chunk) {
  const auto ranks = static_cast<std::size_t>(ranks_.size());
  const KeySlice* const slices = slices_.data() + round * ranks;
  const KeyWindow keys = window_of(slices, ranks);
  if (chunk >= chunks_.size() || !has_keys_in(chunk, keys))
    return std::vector<Communicator::Bytes>(ranks);
  const KeyedSplats keyed =
      projector_.keyed_memory(static_cast<std::uint32_t>(most_splats_of(chunk)));
  const std::uint32_t count = project(chunk, keys, keyed, 0);
  return pack(context_, keyed, count, ranks, [&](std::uint64_t key) {
    return slice_of({key, first_chunk_ + chunk}, slices, ranks);
  });
}

// Splats come by ranks, and by chunks of each: in the order of their particles.
void SplatSlices::exchange(std::size_t round, const KeyedSplats& keyed, std::uint32_t first_slot) {
  const auto ranks = static_cast<std::size_t>(ranks_.size());
  const std::uint64_t steps = *std::max_element(chunks_of_ranks_.begin(), chunks_of_ranks_.end());
  std::vector<std::vector<Communicator::Bytes>> received(ranks);
  for (std::size_t step = 0; step < steps; ++step) {
    std::vector<Communicator::Bytes> packets = share_out(round, step);
    for (std::size_t r = 0; r < ranks; ++r) {
      if (r != static_cast<std::size_t>(ranks_.rank())) ranks_.work.sent_bytes += packets[r].size();
    }
    packets = ranks_.all.exchange(std::move(packets));
    for (std::size_t r = 0; r < ranks; ++r)
      received[r].push_back(std::move(packets[r]));
  }
  std::uint64_t slot = first_slot;
  for (std::vector<Communicator::Bytes>& of_rank : received) {
    for (Communicator::Bytes& packet : of_rank) {
      const std::uint64_t count = splats_in(packet);
      if (slot + count <= keyed.count) unpack(context_, packet, keyed, slot);
      slot += count;
      packet = {};
    }
  }
  check(slot - first_slot, keyed.count - first_slot);
}

void SplatSlices::check(std::uint64_t found, std::uint64_t counted) const {
  if (found == counted) return;
  throw DeviceError("device " + context_.device.device.name() + ": counted " +
                    std::to_string(counted) + " splats of a slice and was given " +
                    std::to_string(found) +
                    ": use the same device and the same version everywhere");
}

}  // namespace splotchcl
