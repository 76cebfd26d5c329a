#pragma once

#include <string>

#include "cli/commands.h"
#include "splotchcl/frame.h"
#include "splotchcl/plan.h"
#include "splotchcl/scene.h"

namespace splotchcl::cli {

// What --explain prints: the plan, and what it will take to draw, as comments; then the scene. So
// the whole is a scene file. `pictures` are how many frames of a film look like this one.
void print_explanation(const FramePlan& plan, const Frame& frame, const Scene& scene,
                       const DrawOptions& options, int pictures);

}  // namespace splotchcl::cli
