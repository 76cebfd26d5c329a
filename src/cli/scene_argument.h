#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"

namespace splotchcl::cli {

struct SceneWithSnapshot {
  Scene scene;
  std::shared_ptr<const Snapshot> snapshot;  // opened; no particle has been read
  std::vector<std::string> notes;            // on the scene, a line each
};

// Whether `path` is a parameter file of the original program, by its ending.
bool is_par_file(const std::filesystem::path& path);

// `path` is a scene file, a parameter file of the original program, or a snapshot for which a
// scene is chosen; `settings` override each.
SceneWithSnapshot open_scene(const std::filesystem::path& path,
                             const std::vector<std::string>& settings);

}  // namespace splotchcl::cli
