#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "splotchcl/scene.h"

namespace splotchcl {

class Communicator;
class Snapshot;

// A scene and what it draws.
struct SceneWithSnapshot {
  Scene scene;
  std::shared_ptr<const Snapshot> snapshot;  // opened; no particle has been read
  std::vector<std::string> notes;            // on the scene, a line each
  std::optional<Scene> suggested;            // of a snapshot: the scene before the settings
  std::optional<Camera> suggested_camera;    // the same of a scene that leaves it to its look
};

// Whether `path` is a parameter file of the original program, by its ending.
bool is_par_file(const std::filesystem::path& path);

// What the command line takes for a scene: a scene file, a parameter file of the original program,
// a snapshot, for which a scene is chosen, or a pattern of a sequence of them (snapshot_%03d), of
// which the last is drawn. `settings` are "key=value" strings of scene keys
// that override it. Throws UsageError for a scene or a setting that is wrong, DataError for files
// that cannot be read. Where all of `ranks` make the call, of the same files, they look at
// particles together, each at its share: then, and whenever what the snapshot draws is decided or
// loaded. `look` is that of a snapshot for which the settings name none.
SceneWithSnapshot open_scene(const std::filesystem::path& path,
                             const std::vector<std::string>& settings = {},
                             const std::shared_ptr<Communicator>& ranks = nullptr,
                             Look look = Look::press);

}  // namespace splotchcl
