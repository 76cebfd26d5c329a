#pragma once

#include <cstdint>

#include "device/device_context.h"
#include "device/frame_layout.h"
#include "device/projector.h"
#include "splotchcl/frame.h"

namespace splotchcl {

// The lists of one binning pass, as compositing takes them.
struct TileLists {
  compute::buffer entries, segments, totals;
  std::uint64_t entry_count = 0;
  std::uint32_t segment_count = 0;
  std::uint32_t partial_count = 0;
  std::uint32_t used_grids = 0;  // bit g: grid g has entries
};

// Splats to lists per tile: the stage `bin`.
class Binner {
 public:
  Binner(DeviceContext& device, const FrameLayout& layout, const Frame& frame, const Plan& plan,
         const compute::buffer& grids);

  // Lists of the splats in slots [first, first + length) of each block of a projection.
  // Returns false, having done nothing else, when they need more entries than fit.
  bool bin_blocks(const SplatBlocks& blocks, std::uint32_t first, std::uint32_t length,
                  TileLists& lists);
  // Lists of splats order[first] ... order[first + count - 1].
  bool bin_order(const compute::buffer& order, std::uint32_t first, std::uint32_t count,
                 TileLists& lists);

 private:
  bool bin(const kernel::BinParameters& parameters, const compute::buffer& order, TileLists& lists);
  void upload_colors(const Frame& frame);

  DeviceContext& device_;
  const FrameLayout& layout_;
  kernel::BinParameters parameters_{};
  compute::buffer grids_, component_colors_, knots_;
  compute::program program_;
  std::uint64_t entry_capacity_ = 0;
  std::uint32_t segment_capacity_ = 0;
  std::uint32_t entry_bytes_ = 0;
  bool ordered_ = false;
};

}  // namespace splotchcl
