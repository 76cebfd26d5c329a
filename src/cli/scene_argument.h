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
};

// `path` is a scene file, or a snapshot for which a scene is chosen; `settings` override
// either. Throws UsageError for parameter files of the original program.
SceneWithSnapshot open_scene(const std::filesystem::path& path,
                             const std::vector<std::string>& settings);

}  // namespace splotchcl::cli
