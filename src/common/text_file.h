#pragma once

#include <filesystem>
#include <string>

namespace splotchcl {

// A small text file as a whole. Throws DataError when it cannot be read, or is so large
// that it is no text file of ours.
std::string read_text_file(const std::filesystem::path& path);

}  // namespace splotchcl
