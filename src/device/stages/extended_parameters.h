#pragma once

#include "device/frame/stage_context.h"

namespace splotchcl {

// Constants of the extended projection (kernels/project/project_extended.cl) of one of the
// frame's components.
shared::ExtendedParameters make_extended_parameters(const StageContext& context,
                                                    const DrawnComponent& component);

}  // namespace splotchcl
