#pragma once

#include <cstdint>

#include "device/device_context.h"
#include "device/frame_layout.h"
#include "splotchcl/frame.h"
#include "splotchcl/image.h"

namespace splotchcl {

// Planes of all grids to the picture: the stage `resolve`.
class Resolver {
 public:
  Resolver(DeviceContext& device, const FrameLayout& layout, const Frame& frame, const Plan& plan,
           const compute::buffer& grids);

  // used_grids: bit g where the planes of grid g hold light.
  Image resolve(const compute::buffer& planes, std::uint32_t used_grids);

 private:
  void collect(const compute::buffer& planes, std::uint32_t used_grids);
  void blur(const compute::buffer& planes, std::uint32_t source, std::uint32_t target,
            double sigma2, bool add);
  void refine(const compute::buffer& planes, std::uint32_t coarse, std::uint32_t fine, bool add);
  compute::buffer upload_background();

  DeviceContext& device_;
  const FrameLayout& layout_;
  const Frame& frame_;
  kernel::ResolveParameters parameters_{};
  compute::buffer grids_;
  compute::program program_, blur_program_;
};

}  // namespace splotchcl
