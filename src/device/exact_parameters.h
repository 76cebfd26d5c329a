#pragma once

#include "device/kernel_parameters.h"
#include "splotchcl/frame.h"

namespace splotchcl {

// A power of two near the scene's size: lengths times it keep sigma^2 inside single
// precision, whether they are in centimetres or in megaparsecs.
double length_scale(const Frame& frame);

// Constants of the exact projection (kernels/project_exact.cl) of one of the frame's
// components.
kernel::ExactParameters make_exact_parameters(const Frame& frame, const DrawnComponent& component);

}  // namespace splotchcl
