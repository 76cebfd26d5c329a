#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "splotchcl/palette.h"

namespace splotchcl {

// `name` is a file (.pal of the original program, or a palette file of ours, docs/palettes.md),
// looked for in `relative_to`, or the name of a palette: one of the user's own, in the folder that
// the environment variable SPLOTCHCL_PALETTES names, or one of the program's. Throws UsageError
// with the nearest names, DataError for a file that is no palette.
Palette load_palette(const std::string& name, const std::filesystem::path& relative_to = {});
// Of the program's own palettes, in alphabetical order.
std::vector<std::string> palette_names();

}  // namespace splotchcl
