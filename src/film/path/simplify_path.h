#pragma once

#include <string>
#include <vector>

#include "splotchcl/scene.h"

namespace splotchcl {

// The scene's keyframes, such as those of a recorded flight, without those that the others replace
// within path.simplify: at the frame of each the film comes as close to what it said. Those that
// are eased or dwell stay. The scene itself where it does not ask for that. `notes` takes how many
// are left. Throws UsageError as KeyframeTracks.
Scene with_simple_path(Scene scene, std::vector<std::string>& notes);

}  // namespace splotchcl
