#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "device/frame/records.h"
#include "device/frame/stage_context.h"
#include "device/ranks/rank_share.h"
#include "device/stages/compositor.h"
#include "splotchcl/communicator.h"
#include "surroundings/cloud_around.h"

namespace splotchcl {

// Where a splat of this sort key goes.
using PacketOfKey = std::function<std::size_t(std::uint64_t key)>;

// The first `count` of these splats with their keys, as ranks send them to each other: each in the
// packet of its key, or in none where there is no such; in their order.
std::vector<Communicator::Bytes> pack(const StageContext& context, const KeyedSplats& keyed,
                                      std::uint32_t count, std::size_t packets,
                                      const PacketOfKey& packet_of);

std::uint64_t splats_in(const Communicator::Bytes& packet);
// Writes them and their keys from slot `slot` on.
void unpack(const StageContext& context, const Communicator::Bytes& packet,
            const KeyedSplats& keyed, std::uint64_t slot);

// Collective: the clouds of all ranks, those of the first one first; known to all.
std::vector<CloudAround> gather_clouds(Communicator& ranks, const std::vector<CloudAround>& own);

// Light from one rank's device to another's, bit for bit.
class LightTransfer {
 public:
  LightTransfer(const StageContext& context, const Compositor& compositor, FrameRanks& ranks)
      : context_(context), compositor_(compositor), ranks_(ranks) {}

  // Of all grids that have light. What comes of a slab is put into the memory of `slab`.
  void send(const SplatLight& light, int to) const;
  SplatLight receive(int from, SlabLight slab = {}) const;

  // Rows of tiles of the picture's own grid alone; `cells` has cells_per_tile of each tile.
  struct Rows {
    const Planes& planes;
    const Buffer<float>& cells;
    std::uint32_t cells_per_tile;
  };
  void send(const Rows& rows, const TileBand& tiles, int to) const;
  void receive(const Rows& rows, const TileBand& tiles, int from) const;

 private:
  // Of a buffer, `count` floats from `first` on.
  using PassFloats =
      std::function<void(const Buffer<float>&, std::uint64_t first, std::uint64_t count)>;
  PassFloats sending(int to) const;
  PassFloats receiving(int from) const;
  void each_part(const SplatLight& light, const PassFloats& pass) const;
  void each_part(const Rows& rows, const TileBand& tiles, const PassFloats& pass) const;

  const StageContext& context_;
  const Compositor& compositor_;
  FrameRanks& ranks_;
};

}  // namespace splotchcl
