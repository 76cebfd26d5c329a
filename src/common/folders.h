#pragma once

#include <filesystem>

namespace splotchcl {

// Where a file lies, as a path that can be opened: of a name alone ".".
inline std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : ".";
}

// Where temporary files go. Throws DataError where TMPDIR names no folder.
std::filesystem::path temporary_folder();

}  // namespace splotchcl
