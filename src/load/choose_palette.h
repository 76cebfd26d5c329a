#pragma once

#include "splotchcl/palette.h"
#include "splotchcl/scene.h"

namespace splotchcl {

// What a component shines and absorbs in; white where particles have colors of their own. Throws
// UsageError for a palette that there is not.
Palette choose_palette(const Component& component);

}  // namespace splotchcl
