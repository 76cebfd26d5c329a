#pragma once

#include <optional>
#include <string>

#include "splotchcl/palette.h"
#include "splotchcl/scene.h"

namespace splotchcl {

// What a component shines and absorbs in; white where particles have colors of their own. Throws
// UsageError for a palette that there is not.
Palette choose_palette(const Component& component);

// Says that without a field all of a component's particles have the first color of its palette, if
// that is much darker than the palette's others.
std::optional<std::string> tell_dark_color(const Component& component, const Palette& palette);

}  // namespace splotchcl
