#include "splotchcl/load.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "finish/finish_picture.h"
#include "load/components.h"
#include "load/frame_loader.h"
#include "load/missing_sizes.h"
#include "load/passes.h"
#include "ranks/exchange.h"
#include "ranks/spread_particles.h"
#include "scene/scalar_map.h"
#include "snapshot/load_memory.h"
#include "splotchcl/error.h"
#include "splotchcl/scene.h"
#include "splotchcl/scene_file.h"

namespace splotchcl {
namespace {

// Ranks that ask for different things would wait for each other for ever. Collective; throws
// UsageError, agreed upon, where they have not the same scene.
void require_same_scene(const Scene& scene, const SpreadParticles& spread) {
  Communicator& ranks = spread.ranks();
  std::string own;
  const std::string failure = told([&] { own = format_scene(scene); });
  const std::vector<std::string> all = gather_texts(ranks, failure + own);
  const auto other = std::find_if(all.begin(), all.end(),
                                  [&](const std::string& text) { return text != all.front(); });
  if (failure.empty() && other == all.end()) return;
  agree(&ranks, [&] {
    if (ranks.rank() > 0) return;
    throw UsageError(
        fmt::format("found another scene on rank {} than on rank 0, expected the same on all ranks "
                    "that draw together",
                    other - all.begin()));
  });
}

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
  require_chosen_components(scene);
  check_finish(scene, snapshot.info());
  std::vector<std::string> ignored;
  OpenComponents(scene, snapshot, missing_sizes(scene, {}), ignored);
}

namespace {

bool is_decided(const FieldMap& map) {
  return map.field.empty() || (map.minimum && map.maximum);
}

void fix(FieldMap& map, const ScalarMap& decided) {
  if (is_decided(map)) return;
  if (!map.minimum) map.minimum = unscaled(decided.minimum, map.scaling);
  if (!map.maximum) map.maximum = unscaled(decided.maximum, map.scaling);
  map.percentiles.reset();
}

void fix(Component& component, const DecidedComponent& decided) {
  if (!component.weight) component.weight = decided.weight;
  if (!decided.has_particles) return;
  fix(component.color, decided.color);
  fix(component.intensity, decided.intensity);
  if (!component.reference_column && decided.is_seen) {
    component.reference_column = decided.reference_column * decided.particles_per_drawn;
  }
}

}  // namespace

Scene fixed_scene(const DecidedScene& decided) {
  Scene scene = decided.scene;
  for (std::size_t i = 0; i < scene.components.size(); ++i)
    fix(scene.components[i], decided.components.at(i));
  return scene;
}

bool is_decided(const Scene& scene) {
  const bool has_all =
      std::all_of(scene.components.begin(), scene.components.end(), [](const Component& component) {
        return component.weight && component.reference_column && is_decided(component.color) &&
               is_decided(component.intensity);
      });
  return scene.camera && has_all;
}

}  // namespace splotchcl
