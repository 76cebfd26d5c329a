#pragma once

#include <functional>
#include <string>
#include <vector>

#include "splotchcl/frame.h"
#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// A camera, components, fields and palettes that suit the data, every value spelled
// out so that it can be saved as a scene file.
Scene suggest_scene(const Snapshot& snapshot);

// Reads what the scene uses, and no more, and decides every number that the scene
// leaves to the data. Missing smoothing lengths are found (density and mass, else
// nearest neighbours). `notes` takes what the user should know, a line each.
// `progress` is called with what is being done and the fraction done, where it takes long.
using LoadProgress = std::function<void(const std::string& what, double fraction)>;
Frame load_frame(const Scene& scene, const Snapshot& snapshot, std::vector<std::string>& notes,
                 const LoadProgress& progress = {});

// Throws what load_frame would throw for this scene before it reads particles: unknown fields,
// palettes and fonts, files that are missing.
void check_load(const Scene& scene, const Snapshot& snapshot);

// The scene with what it leaves to the data (camera, ranges of fields, weights, reference
// columns) as load_frame decided it for this frame of the scene. The frames of a film are
// drawn with what one of them decided, or they would flicker. What follows from particles
// stays open for a component of which the frame has or shows none.
Scene decide_scene(const Scene& scene, const Frame& frame);
// Whether nothing is left to the data.
bool is_decided(const Scene& scene);

}  // namespace splotchcl
