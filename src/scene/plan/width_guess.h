#pragma once

#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// How many splats the whole picture has that could be stencils, from some of its particles; the
// same for every crop. `narrowest`: of stencils, in pixels.
WideSplats guess_wide_splats(const Frame& frame, double narrowest);

}  // namespace splotchcl
