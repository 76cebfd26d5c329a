#pragma once

#include <string>

#include "splotchcl/film.h"
#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// Gives a scene that says nothing of a film one that suits its data: an orbit around what a
// snapshot shows, or a sequence in its order of time with a slow orbit. With a dive it goes from
// what the scene's camera shows to the densest place or a halo, through time where there is a
// sequence; or it orbits around that all along. What the scene says of frames stays. The scene has
// a camera, and its components. `snapshot` is one of the scene's. Throws UsageError for a target
// that is none, and for one in a scene with a path. Returns a note of what was chosen, or "".
std::string suggest_film(const FilmTarget& target, const Snapshot& snapshot, Scene& scene);

// Moves the camera of a sequence's suggested scene so far away that it shows what there is at any
// time, from wherever an orbit leads it. Periodic boxes stay as they are. Throws as readers do.
void show_whole_course(Scene& scene);

// Brings a camera that looks in all directions, and was chosen from the data as if it looked in
// one, so near that matter is around it. Where it has no target to come close to, what does fades,
// so that clouds around the camera, of which there are thousands there, need not be looked through.
// Other cameras stay.
void stand_amid_matter(Camera& camera, bool has_target);

}  // namespace splotchcl
