#include "gpu_model/scene_frame.h"

#include <memory>

#include "splotchcl/load.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl::bench {

Frame frame_of_scene(const std::string& path, const std::vector<std::string>& settings) {
  const Scene scene = read_scene_file(path, settings);
  const std::unique_ptr<Snapshot> snapshot = open_snapshot(scene.snapshot);
  std::vector<std::string> notes;
  return load_frame(scene, *snapshot, notes);
}

}  // namespace splotchcl::bench
