#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "splotchcl/palette.h"

namespace splotchcl {

// `name` is a file (.pal of the original program, or a palette file of ours, docs/palettes.md),
// looked for in `relative_to`, or the name of a palette: one of the user's own, in the folder that
// the environment variable SPLOTCHCL_PALETTES names, or one of the program's. Throws UsageError
// with the nearest names, DataError for a file that is no palette. A name that ends in _r and that
// no palette has is the palette of the name before it, reversed.
Palette load_palette(const std::string& name, const std::filesystem::path& relative_to = {});
// The file of the user's own that load_palette(name) reads; empty where it reads none, or a file
// that is named by its path.
std::filesystem::path own_palette_file(const std::string& name);
// Of the program's own palettes, in alphabetical order.
std::vector<std::string> palette_names();

// A palette that has a name.
struct PaletteInfo {
  std::string name;
  std::filesystem::path file;  // empty: one of the program's own
  std::string description;     // what the file's first comment says; empty where there is none
};
// The program's own palettes and those of the folder that SPLOTCHCL_PALETTES names, in alphabetical
// order whatever the case. Throws UsageError where that is no folder.
std::vector<PaletteInfo> list_palettes();

}  // namespace splotchcl
