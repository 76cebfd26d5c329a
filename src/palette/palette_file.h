#pragma once

#include <string>

#include "splotchcl/palette.h"

namespace splotchcl {

// Whether a scene means a file by this, rather than the name of a palette: it has a '/'
// or a '.' in it.
bool is_palette_path(const std::string& name);

// The text of a palette file of ours (docs/palettes.md), or of the original program's
// .pal, told apart by content. Throws DataError with name_for_messages and line.
Palette parse_palette(const std::string& text, const std::string& name_for_messages);

// What the first comment of a palette file says, without "name:" in front; the first line of the
// original program's .pal. Empty where there is none.
std::string palette_description(const std::string& text, const std::string& name);

}  // namespace splotchcl
