#pragma once

#include <filesystem>
#include <string>

namespace splotchcl {

// The file of a font that is named by its path, or by its name in one of the folders where
// systems keep fonts. Throws UsageError that says what to install.
std::filesystem::path find_font(const std::string& name);

}  // namespace splotchcl
