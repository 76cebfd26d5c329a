#pragma once

#include <vector>

#include "splotchcl/image.h"
#include "splotchcl/palette.h"

namespace splotchcl::cli {

// The palettes' names beside bars of their colours, lowest values on the left, in as many columns
// as keep the picture from getting taller than wide. The lower half of a bar is what the palette
// absorbs, where it has absorption colours of its own. Throws UsageError where no font is found.
Image draw_palette_preview(const std::vector<Palette>& palettes);

}  // namespace splotchcl::cli
