#pragma once

#include <cstdint>

#include "device/frame/records.h"
#include "device/frame/stage_context.h"
#include "device/ranks/rank_share.h"
#include "device/stages/compositor.h"

namespace splotchcl {

// Light from one rank's device to another's, bit for bit.
class LightTransfer {
 public:
  LightTransfer(const StageContext& context, const Compositor& compositor, FrameRanks& ranks)
      : context_(context), compositor_(compositor), ranks_(ranks) {}

  // Of all grids that have light.
  void send(const SplatLight& light, int to) const;
  SplatLight receive(int from) const;

  // Rows of tiles of the picture's own grid alone; `cells` has cells_per_tile of each tile.
  struct Rows {
    const Planes& planes;
    const Buffer<float>& cells;
    std::uint32_t cells_per_tile;
  };
  void send(const Rows& rows, const TileBand& tiles, int to) const;
  void receive(const Rows& rows, const TileBand& tiles, int from) const;

  void send(const SlabLight& slab, int to) const;
  void receive(const SlabLight& slab, int from) const;

 private:
  template <class T>
  void send_values(const Buffer<T>& buffer, std::uint64_t first, std::uint64_t count, int to) const;
  template <class T>
  void receive_values(const Buffer<T>& buffer, std::uint64_t first, std::uint64_t count,
                      int from) const;
  // Calls pass(first float, count) for the rows' part of each plane.
  template <class Pass>
  void in_planes(const TileBand& tiles, const Pass& pass) const;

  const StageContext& context_;
  const Compositor& compositor_;
  FrameRanks& ranks_;
};

}  // namespace splotchcl
