#pragma once

#include "device/frame/component_colors.h"
#include "device/frame/picture_layout.h"
#include "device/frame/variant.h"
#include "device/opencl/device_context.h"
#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// What all stages of one frame read, and none changes. The frame, the plan and the device
// outlive it.
struct StageContext {
  StageContext(DeviceContext& on, const Frame& of, const FramePlan& with)
      : device(on),
        frame(of),
        plan(with),
        variant(of, with, on.traits),
        layout(make_picture_layout(of, with, variant)),
        grids(on.pool.upload(all_grids(layout), "grids")),
        stencils(on.pool.upload(stencils_of_blurs(with.pyramid), "stencils")),
        colors(upload_component_colors(of, with.light, on.pool)) {}

  DeviceContext& device;
  const Frame& frame;
  const FramePlan& plan;
  const Variant variant;
  const PictureLayout layout;
  const Buffer<shared::Grid> grids;
  const Buffer<shared::Stencil> stencils;
  const ComponentColorTable colors;
};

}  // namespace splotchcl
