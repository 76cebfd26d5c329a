#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "splotchcl/scene.h"

namespace splotchcl {

// A parameter file of the original Splotch as a scene that draws the same picture
// (docs/original-files.md). Files that it names are looked for beside it, then in the current
// folder. `settings` are "key=value" strings of scene keys that override it. `notes` takes a
// line for each key that has no counterpart or another effect; none is left out silently.
// Throws UsageError with file, line and key.
Scene read_par_file(const std::filesystem::path& path, const std::vector<std::string>& settings,
                    std::vector<std::string>& notes);

// The scene with the paths of files as they are written in a scene file in `folder`: relative to
// it, unless they are absolute.
Scene with_paths_from(Scene scene, const std::filesystem::path& folder);

}  // namespace splotchcl
