#pragma once

#include "device/frame/shared.h"
#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// Constants of the extended projection (kernels/project/project_extended.cl) of one of the
// frame's components.
shared::ExtendedParameters make_extended_parameters(const Frame& frame, const FramePlan& plan,
                                                    const DrawnComponent& component);

}  // namespace splotchcl
