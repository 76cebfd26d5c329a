#pragma once

#include "device/frame/stage_context.h"

namespace splotchcl {

// What the places of sharp splats of one of the frame's components follow from
// (kernels/project/sharp_places.cl).
shared::SharpParameters make_sharp_parameters(const StageContext& context,
                                              const DrawnComponent& component);

}  // namespace splotchcl
