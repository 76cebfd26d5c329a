#pragma once

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

  Image resolve(const compute::buffer& planes);

 private:
  void refine(const compute::buffer& planes);
  compute::buffer upload_background();

  DeviceContext& device_;
  const FrameLayout& layout_;
  const Frame& frame_;
  kernel::ResolveParameters parameters_{};
  compute::buffer grids_;
  compute::program program_;
};

}  // namespace splotchcl
