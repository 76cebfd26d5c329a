#pragma once

#include <optional>

#include "splotchcl/finish.h"
#include "splotchcl/image.h"
#include "splotchcl/views.h"

namespace splotchcl {

// Both mix linear light and alpha, (1 - amount) of the picture and amount of the other.
void mix(Image& image, const Image& other, double amount);  // of the same size
void fade_to_color(Image& image, const FinishSettings& finish, double gamma);

// Throws UsageError where the scene's finish.cross_fade cannot be drawn.
void check_cross_fade(const Scene& scene);

// The other scene of a cross-fade as it is drawn here: in this scene's size and gamma, with its
// camera where it has none, and at its moment where it has the same sequence. Nothing without a
// cross-fade.
std::optional<Scene> cross_fade_scene(const Scene& scene);

}  // namespace splotchcl
