#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "device/frame/picture_layout.h"
#include "device/frame/records.h"
#include "device/frame/stage_context.h"
#include "device/ranks/rank_share.h"
#include "device/ranks/transfers.h"
#include "device/stages/projector.h"

namespace splotchcl {

// All 48 bits of those of the splats' keys that are not above `last`.
std::vector<std::uint64_t> sort_keys_up_to(const StageContext& context, const KeyedSplats& keyed,
                                           std::uint64_t last);

// From one slice of an ordered frame to the next, which another rank may have: what has been
// composited, and the last splats, whose chunk ends behind the slice. After each round the last
// rank passes on to the first one, which is itself where one process draws.
class Relay {
 public:
  // All of them outlive it.
  Relay(const StageContext& context, const Projector& projector, const LightTransfer& transfer,
        FrameRanks& ranks)
      : context_(context), projector_(projector), transfer_(transfer), ranks_(ranks) {}

  bool is_first_rank() const { return ranks_.rank() == 0; }
  bool is_last_rank() const { return ranks_.rank() + 1 == ranks_.size(); }
  // Whether there is a slice of another rank before, in this round or the last one's.
  bool has_other_before(std::size_t round) const {
    return ranks_.size() > 1 && (round > 0 || !is_first_rank());
  }

  // The last `count` of the slice's splats, in their order; they go to the next rank at once, but
  // that the last rank of a round keeps them.
  void pass_splats(const SortedSplats& sorted, std::uint32_t count);
  // The last rank's, to the first of the next round. All ranks are needed until the splats of that
  // round are where they belong, so it waits with that.
  void pass_round(const SplatLight& light);
  // What the slice before has passed, into the first `count` slots.
  void take_splats(std::size_t round, const Buffer<std::byte>& splats, std::uint32_t count);

  // What compositing goes on with, to the next rank of this round and from the one before.
  void send_on(const SplatLight& light) const {
    if (!is_last_rank()) transfer_.send(light, ranks_.rank() + 1);
  }
  SplatLight receive_light(SlabLight slab) const {
    return transfer_.receive(rank_before(), std::move(slab));
  }
  // Of the last slice, to the first rank.
  SplatLight bring_home(SplatLight light) const;

 private:
  int rank_before() const { return is_first_rank() ? ranks_.size() - 1 : ranks_.rank() - 1; }
  void send_splats(int to) const;

  const StageContext& context_;
  const Projector& projector_;
  const LightTransfer& transfer_;
  FrameRanks& ranks_;
  std::vector<std::byte> splats_;  // that are passed on
};

// The rows of tiles of a picture of one grid in which ranks pass it on: while one composites a
// band, the rank before is at the next. A rank waits for as many bands as there are ranks before
// it, and with twice as many bands as ranks for less than half of the time.
std::vector<TileBand> relay_bands(const PictureLayout& layout, int ranks);

// What of the bands lies in this one.
std::vector<TileBand> parts_in(const TileBand& whole, const std::vector<TileBand>& bands);

}  // namespace splotchcl
