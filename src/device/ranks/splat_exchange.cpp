#include "device/ranks/splat_exchange.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include "device/frame/splat_capacity.h"
#include "device/ranks/rank_share.h"
#include "device/ranks/splat_packets.h"
#include "device/stages/window_projector.h"
#include "ranks/exchange.h"
#include "splotchcl/error.h"

namespace splotchcl {
SplatExchange::SplatExchange(const StageContext& context, const Projector& projector,
                             ParticleStore& particles, FrameRanks& ranks)
    : context_(context),
      projector_(projector),
      ranks_(ranks),
      counter_(context, projector, particles,
               particles_of_rank(context.frame, context.device.traits, ranks.rank(), ranks.size())),
      chunks_of_ranks_(gather_values(ranks.all, counter_.chunks().size())) {
  first_chunk_ = std::accumulate(chunks_of_ranks_.begin(), chunks_of_ranks_.begin() + ranks.rank(),
                                 std::uint64_t{0});
  for (const ParticleChunk& chunk : counter_.chunks())
    ranks.work.particles += chunk.count();
}

void SplatExchange::count_keys() {
  const CountedKeys counted = count_everywhere({}, shift_of_all_keys);
  counts_ = counter_.particles();
  own_around_ = counts_.around;
  left_out_ = counter_.left_out();
  add_up(ranks_.all,
         {&counts_.visible, &counts_.bad, &counts_.too_sharp, &counts_.around, &left_out_});
  if (counts_.too_sharp > 0) return;
  capacity_ = smallest_of(ranks_.all, splat_capacity(context_));
  slices_ = cut_in_slices(
      counted, static_cast<std::size_t>(ranks_.size()), capacity_,
      [this](const KeyWindow& window, int shift) { return count_everywhere(window, shift); },
      [this](const KeyWindow& window) { return count_chunks(window); });
}

CountedKeys SplatExchange::count_everywhere(const KeyWindow& window, int shift) {
  CountedKeys counted = counter_.count(window, shift);
  ranks_.all.add_up(counted.bins);
  return counted;
}

std::vector<std::uint64_t> SplatExchange::count_chunks(const KeyWindow& window) {
  std::vector<std::uint64_t> counts(static_cast<std::size_t>(
      std::accumulate(chunks_of_ranks_.begin(), chunks_of_ranks_.end(), std::uint64_t{0})));
  for (std::size_t c = 0; c < counter_.chunks().size(); ++c)
    counts[static_cast<std::size_t>(first_chunk_) + c] = counter_.count_in_chunk(c, window);
  ranks_.all.add_up(counts);
  return counts;
}

bool SplatExchange::has_room_for_copies() const {
  return rounds() == 1 && std::all_of(slices_.begin(), slices_.end(), [&](const KeySlice& slice) {
           return 2 * slice.splats <= capacity_;
         });
}

std::size_t SplatExchange::number_of_slice(std::size_t round, int rank) const {
  return round * static_cast<std::size_t>(ranks_.size()) + static_cast<std::size_t>(rank);
}

const KeySlice& SplatExchange::slice(std::size_t round, int rank) const {
  return slices_[number_of_slice(round, rank)];
}

KeyWindow SplatExchange::window(std::size_t round) const {
  return window_of(&slice(round, 0), static_cast<std::size_t>(ranks_.size()));
}

// One of this rank's chunks, projected: a packet for each rank.
std::vector<Communicator::Bytes> SplatExchange::share_out(std::size_t round, std::size_t chunk) {
  const auto ranks = static_cast<std::size_t>(ranks_.size());
  const KeyWindow keys = window(round);
  if (chunk >= counter_.chunks().size() || !counter_.has_keys_in(chunk, keys))
    return std::vector<Communicator::Bytes>(ranks);
  const KeyedSplats keyed =
      projector_.keyed_memory(static_cast<std::uint32_t>(counter_.most_splats_of(chunk)));
  const std::uint32_t count =
      projector_.project_window(counter_.chunks()[chunk], counter_.particles_of(chunk), keys,
                                counter_.blocks_without(chunk, keys), keyed, 0);
  const HostSplats splats = download_splats(context_, keyed, count);
  std::vector<std::uint32_t> places(count);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const SplatPlace place = {splats.key(i), first_chunk_ + chunk};
    places[i] = static_cast<std::uint32_t>(slice_of(place, &slice(round, 0), ranks));
  }
  return pack(context_, splats, places, ranks);
}

KeyedSplats SplatExchange::take(std::size_t round, std::uint32_t carried, std::uint32_t more) {
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
  const KeySlice& own = slice(round, ranks_.rank());
  const std::uint32_t count = carried + static_cast<std::uint32_t>(own.splats);
  KeyedSplats keyed = projector_.keyed_memory(count + more);
  keyed.count = count;
  put_together(received, keyed, carried);
  return keyed;
}

// By ranks, and by chunks of each: the order of their particles.
void SplatExchange::put_together(std::vector<std::vector<Communicator::Bytes>>& received,
                                 const KeyedSplats& keyed, std::uint32_t carried) const {
  BufferPool& pool = context_.device.pool;
  std::vector<std::uint32_t> order(carried);
  std::iota(order.begin(), order.end(), 0u);
  pool.write(keyed.order, 0, order.data(), carried);
  pool.write(keyed.keys, 0, std::vector<std::uint32_t>(carried).data(), carried);
  if (keyed.key_ends.size() > 0)
    pool.write(keyed.key_ends, 0, std::vector<std::uint16_t>(carried).data(), carried);
  std::uint64_t slot = carried;
  for (std::vector<Communicator::Bytes>& of_rank : received) {
    for (Communicator::Bytes& packet : of_rank) {
      const std::uint64_t count = splats_in(packet);
      if (slot + count > keyed.count) break;
      unpack(context_, packet, keyed, slot);
      slot += count;
      packet = {};
    }
  }
  if (slot != keyed.count) {
    throw DeviceError("device " + context_.device.device.name() + ": counted " +
                      std::to_string(keyed.count - carried) + " splats of a slice and was given " +
                      std::to_string(slot - carried) +
                      ": use the same device and the same version everywhere");
  }
}

}  // namespace splotchcl
