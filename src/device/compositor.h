#pragma once

#include "device/binner.h"
#include "device/device_context.h"
#include "device/frame_layout.h"

namespace splotchcl {

// Lists to light: adds the splats of a pass to the planes, or lays them behind what is
// already there: the stage `composite`.
class Compositor {
 public:
  Compositor(DeviceContext& device, const FrameLayout& layout, const Frame& frame, const Plan& plan,
             const compute::buffer& grids, bool rows);

  // Sets the picture's own planes to the layer (0, 0).
  void clear();
  void composite(const TileLists& lists);
  const compute::buffer& planes() const { return planes_; }
  // Bit g: grid g has light. The planes of others are undefined.
  std::uint32_t used_grids() const { return used_grids_; }

 private:
  void clear_grid(std::size_t grid);

  DeviceContext& device_;
  const FrameLayout& layout_;
  kernel::CompositeParameters parameters_{};
  compute::buffer grids_, planes_;
  compute::program program_, join_program_;
  bool rows_;
  std::uint32_t used_grids_ = 0;
};

}  // namespace splotchcl
