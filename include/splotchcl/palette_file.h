#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "splotchcl/palette.h"

namespace splotchcl {

// `name` is a file (.pal of the original program, or a palette file of ours), or the
// name of one in the palettes folder. Throws UsageError with the nearest names.
Palette load_palette(const std::string& name, const std::filesystem::path& relative_to = {});
std::vector<std::string> palette_names();

}  // namespace splotchcl
