#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "architecture/target_table.h"

// What must hold for the project at `root`. Each function returns a line for each breach.
namespace splotchcl::test {

// A header or source, a public one too, includes what its target does not link.
std::vector<std::string> find_wrong_includes(const TargetTable& table,
                                             const std::filesystem::path& root);

// A target is linked of which nothing is included.
std::vector<std::string> find_idle_links(const TargetTable& table,
                                         const std::filesystem::path& root);

// A public header belongs to no target or to several, or does not exist.
std::vector<std::string> find_stray_headers(const TargetTable& table,
                                            const std::filesystem::path& root);

// A header or source in src/ belongs to no target.
std::vector<std::string> find_stray_files(const TargetTable& table,
                                          const std::filesystem::path& root);

// Targets need each other.
std::vector<std::string> find_cycles(const TargetTable& table);

}  // namespace splotchcl::test
