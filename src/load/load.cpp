#include "splotchcl/load.h"

#include "finish/finish_picture.h"
#include "load/frame_loader.h"
#include "load/missing_sizes.h"
#include "load/open_components.h"
#include "load/passes.h"
#include "load/same_scene.h"
#include "ranks/agreement.h"
#include "ranks/spread_particles.h"
#include "snapshot/load_memory.h"

namespace splotchcl {
namespace {

// Where ranks look at particles together, all of them do it, or none.
template <class Work>
auto together(const Scene& scene, const Snapshot& snapshot, const Work& work) -> decltype(work()) {
  const auto spread = snapshot.spread();
  if (!spread && !has_shared_passes(snapshot)) return work();
  if (spread) require_same_scene(scene, *spread);
  decltype(work()) result;
  const auto make = [&] { result = work(); };
  try {
    if (spread) {
      spread->agree_on(make);
    } else {
      agree(snapshot.memory().ranks().get(), make);
    }
  } catch (...) {
    // Ranks ended at different places.
    snapshot.memory().forget_own();
    snapshot.own_part().memory().forget_own();
    throw;
  }
  return result;
}

}  // namespace

DecidedScene decide(const Scene& scene, const Snapshot& snapshot, std::vector<std::string>& notes,
                    const LoadProgress& progress) {
  return together(scene, snapshot,
                  [&] { return FrameLoader(scene, snapshot, notes, progress).decide(); });
}

Camera decide_camera(const Scene& scene, const Snapshot& snapshot) {
  std::vector<std::string> ignored;  // decide tells it again
  return together(scene, snapshot,
                  [&] { return FrameLoader(scene, snapshot, ignored, {}).decide_camera(); });
}

Frame load(const DecidedScene& decided, const Snapshot& snapshot, std::vector<std::string>& notes,
           const LoadProgress& progress) {
  return together(decided.scene, snapshot, [&] {
    FrameLoader loader(decided.scene, snapshot, notes, progress);
    loader.begin_load();
    return loader.load(decided);
  });
}

Frame load_frame(const Scene& scene, const Snapshot& snapshot, std::vector<std::string>& notes,
                 const LoadProgress& progress) {
  return together(scene, snapshot, [&] {
    FrameLoader loader(scene, snapshot, notes, progress);
    loader.begin_load();
    loader.read_background();
    return loader.load(loader.decide());
  });
}

void check_load(const Scene& scene, const Snapshot& snapshot) {
  check_finish(scene, snapshot.info());
  std::vector<std::string> ignored;
  OpenComponents(scene, snapshot, missing_sizes(scene, {}), ignored);
}

}  // namespace splotchcl
