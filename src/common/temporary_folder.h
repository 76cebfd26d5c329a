#pragma once

#include <filesystem>

namespace splotchcl {

// Where temporary files go. Throws DataError where TMPDIR names no folder.
std::filesystem::path temporary_folder();

}  // namespace splotchcl
