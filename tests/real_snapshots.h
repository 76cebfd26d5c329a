#pragma once

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "paths.h"

namespace splotchcl::test {

// Every file of the test data that is a snapshot; none where there are no test data.
inline std::vector<std::string> real_snapshots() {
  namespace fs = std::filesystem;
  const fs::path data = test::data_folder();
  std::vector<std::string> names;
  if (!fs::exists(data)) return names;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(data)) {
    const fs::path name = fs::relative(entry.path(), data);
    const std::string folder = name.begin()->string();
    // What is no snapshot: damaged files, pictures, paths, scripts.
    const std::set<std::string> others = {"broken", "camera",    "faults",     "images",
                                          "odd",    "README.md", "splotch_par"};
    const bool has_snapshots = others.count(folder) == 0;
    if (entry.is_regular_file() && has_snapshots) names.push_back(name.string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace splotchcl::test
