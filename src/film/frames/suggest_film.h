#pragma once

#include <string>

#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// Gives a scene that says nothing of a film one that suits its data: an orbit around what a
// snapshot shows, or a sequence in its order of time with a slow orbit. With a dive it goes from
// what the scene's camera shows to the densest place or a halo, through time where there is a
// sequence. What the scene says of frames stays. The scene has a camera, and its components.
// `snapshot` is one of the scene's. `dive` is empty, "densest" or "halo=N". Throws UsageError for
// another, and for a dive in a scene with a path.
void suggest_film(const std::string& dive, const Snapshot& snapshot, Scene& scene);

}  // namespace splotchcl
