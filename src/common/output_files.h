#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace splotchcl {

// A file that a command is going to write, and the option that names it, for messages.
struct OutputFile {
  std::filesystem::path path;
  std::string option;
};

// Called before anything is written. Throws UsageError where two outputs are the same file, or one
// is a file that is read: by its path, through a symbolic link, or as another name of the same
// file. `inputs` is only asked where an output exists already. Outputs that are no regular files,
// such as FIFOs and devices, may be anything.
void check_outputs(const std::vector<OutputFile>& outputs,
                   const std::function<std::set<std::filesystem::path>()>& inputs);

// Throws UsageError where one of the files that are read lies below a folder of the program's own,
// which is removed in the end.
void check_own_folder(const std::filesystem::path& folder, const std::string& option,
                      const std::function<std::set<std::filesystem::path>()>& inputs);

}  // namespace splotchcl
