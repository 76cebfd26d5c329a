#pragma once

#include <functional>
#include <string>
#include <vector>

#include "splotchcl/camera.h"
#include "splotchcl/frame.h"
#include "splotchcl/light_model.h"
#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"

// From a scene and a snapshot to a frame, in two steps. `decide` finds every number that the scene
// leaves to the data; `load` reads the particles of a scene that leaves none. Neither changes what
// it is given, and the same scene and snapshot give the same result.
namespace splotchcl {

// A camera, components, fields and palettes that suit the data, every value spelled
// out so that it can be saved as a scene file. The camera frames them in a picture of the shape of
// `image`; the scene keeps its own size.
Scene suggest_scene(const Snapshot& snapshot, Look look = Look::press,
                    const ImageSettings& image = {});
// A component that suits these types alone, where a user wants others than those suggested.
Component suggest_component(const Snapshot& snapshot, const std::vector<int>& types,
                            Look look = Look::press);
// The particles of the snapshot that no component draws, "not drawn: disk 20000, bulge 5000";
// empty where all are drawn.
std::string tell_not_drawn(const Scene& scene, const Snapshot& snapshot);

// Called with what is being done and the fraction done, 0 to 1, where it takes long.
using LoadProgress = std::function<void(const std::string& what, double fraction)>;

// The numbers of one component that a scene may leave to the data.
struct DecidedComponent {
  WeightModel weight = WeightModel::constant;
  ScalarMap color, intensity;  // of the fields that the component has
  // As DrawnComponent has them.
  double reference_column = 1;
  double particles_per_drawn = 1;
  // Without particles there is nothing that ranges could be taken from: they are 0 to 1. Where
  // the camera sees none of them, the reference column is 1. Another frame of a film, whose
  // selection or camera is another, may do better.
  bool has_particles = true;
  bool is_seen = true;
};

// A scene with every number that it leaves to the data. Its camera is set.
struct DecidedScene {
  Scene scene;
  std::vector<DecidedComponent> components;  // one for each of the scene's
};

// Reads what an open number follows from, and no more: nothing where none is open. `notes` takes
// what the user should know, a line each. Throws UsageError for what the snapshot does not have
// (components, fields) or cannot be (palettes, fonts, limits), DataError for particles that cannot
// be read or used.
DecidedScene decide(const Scene& scene, const Snapshot& snapshot, std::vector<std::string>& notes,
                    const LoadProgress& progress = {});

// The camera alone: the scene's, or one that shows what its components are. Throws as decide does.
Camera decide_camera(const Scene& scene, const Snapshot& snapshot);

// Reads what the scene uses, and no more. Missing smoothing lengths are found (density and mass,
// else nearest neighbors). Throws as decide does.
Frame load(const DecidedScene& decided, const Snapshot& snapshot, std::vector<std::string>& notes,
           const LoadProgress& progress = {});

// load(decide(scene)), reading everything once.
Frame load_frame(const Scene& scene, const Snapshot& snapshot, std::vector<std::string>& notes,
                 const LoadProgress& progress = {});

// Throws what load_frame would throw for this scene before it reads particles: unknown fields,
// palettes and fonts, files that are missing.
void check_load(const Scene& scene, const Snapshot& snapshot);

// The scene that says itself what was decided (camera, ranges of fields, weights, reference
// columns). The frames of a film are drawn with what one of them decided, or they would flicker.
// What follows from particles stays open for a component that has none, or of which none is seen.
Scene fixed_scene(const DecidedScene& decided);
// Whether nothing is left to the data.
bool is_decided(const Scene& scene);

}  // namespace splotchcl
