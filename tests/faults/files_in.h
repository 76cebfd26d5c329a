#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "temporary_folder.h"

namespace splotchcl::test {

// What each file below a folder holds, by its name; of folders nothing, and their names end in '/'.
using Files = std::map<std::string, std::string>;

inline Files files_in(const std::filesystem::path& folder) {
  Files files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string name = std::filesystem::relative(entry.path(), folder).string();
    if (entry.is_directory())
      files[name + "/"] = "";
    else
      files[name] = read_text(entry.path());
  }
  return files;
}

}  // namespace splotchcl::test
