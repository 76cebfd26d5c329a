#pragma once

#include <cstdint>

#include "device/frame/stage_context.h"

namespace splotchcl {

// Constants of the projection of one of the frame's components (kernels/project/project.h),
// without the particles of a launch and the strides of their columns.
shared::ProjectParameters make_project_parameters(const StageContext& context,
                                                  std::uint32_t component);

}  // namespace splotchcl
