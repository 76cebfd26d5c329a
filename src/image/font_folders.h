#pragma once

#include <filesystem>
#include <string>

namespace splotchcl {

// Whether a font is named by its file's path: it holds a slash or ends in .ttf, .otf, .ttc.
bool is_font_path(const std::string& font);

// The file of a font that is named by its path, or by its name in one of the folders where
// systems keep fonts. Throws UsageError that says what to install.
std::filesystem::path find_font(const std::string& name);

}  // namespace splotchcl
