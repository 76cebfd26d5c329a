#pragma once

#include <optional>

#include "splotchcl/views.h"

namespace splotchcl {

// Throws UsageError where the scene's finish.cross_fade cannot be drawn.
void check_cross_fade(const Scene& scene);

// The other scene of a cross-fade as it is drawn here: in this scene's size and gamma, with its
// camera where it has none, and at its moment where it has the same sequence. Nothing without a
// cross-fade.
std::optional<Scene> cross_fade_scene(const Scene& scene);

}  // namespace splotchcl
