#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace splotchcl::test {

// The headers and sources in a folder of the project, relative to its root, in order.
std::vector<std::filesystem::path> source_files(const std::filesystem::path& root,
                                                const std::filesystem::path& folder);

// What a file includes in quotation marks, as it is written.
std::vector<std::string> quoted_includes(const std::filesystem::path& file);

}  // namespace splotchcl::test
