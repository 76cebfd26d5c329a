#pragma once

#include <cstddef>

#include "device/frame/stage_context.h"
#include "device/opencl/buffer_pool.h"
#include "splotchcl/plan.h"
#include "surroundings/smooth_picture.h"

namespace splotchcl {

// Of what is worked out for a pixel of a layer of clouds around the camera: in ordered frames light
// and optical depths, else the sum.
std::size_t channels_of_layer(const FramePlan& plan);

// The layer as the planes of the picture's grid have it (kernels/composite/behind.cl), without
// padding: of the frame's crop. Interpolated in single precision where it `may_round` so, but in
// extended frames as pairs of floats.
Buffer<float> layer_planes(const StageContext& context, const SmoothPicture& layer, bool may_round);

}  // namespace splotchcl
