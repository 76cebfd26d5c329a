#include "splotchcl/load.h"

#include "finish/finish_picture.h"
#include "load/frame_loader.h"
#include "load/missing_sizes.h"
#include "load/open_components.h"

namespace splotchcl {

DecidedScene decide(const Scene& scene, const Snapshot& snapshot, std::vector<std::string>& notes,
                    const LoadProgress& progress) {
  return FrameLoader(scene, snapshot, notes, progress).decide();
}

Camera decide_camera(const Scene& scene, const Snapshot& snapshot) {
  std::vector<std::string> ignored;  // decide tells it again
  return FrameLoader(scene, snapshot, ignored, {}).decide_camera();
}

Frame load(const DecidedScene& decided, const Snapshot& snapshot, std::vector<std::string>& notes,
           const LoadProgress& progress) {
  FrameLoader loader(decided.scene, snapshot, notes, progress);
  loader.begin_load();
  return loader.load(decided);
}

Frame load_frame(const Scene& scene, const Snapshot& snapshot, std::vector<std::string>& notes,
                 const LoadProgress& progress) {
  FrameLoader loader(scene, snapshot, notes, progress);
  loader.begin_load();
  loader.read_background();
  return loader.load(loader.decide());
}

void check_load(const Scene& scene, const Snapshot& snapshot) {
  check_finish(scene, snapshot.info());
  std::vector<std::string> ignored;
  OpenComponents(scene, snapshot, missing_sizes(scene, {}), ignored);
}

}  // namespace splotchcl
