#pragma once

#include <array>
#include <filesystem>

namespace splotchcl {

// What a file of the program's own begins with.
using FileMark = std::array<char, 16>;

// Whether something is there that is not such a file, and must not be overwritten. One that has
// been cut is.
bool is_another_file(const std::filesystem::path& path, const FileMark& mark);

}  // namespace splotchcl
