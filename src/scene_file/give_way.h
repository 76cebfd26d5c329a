#pragma once

#include <functional>
#include <string>

#include "splotchcl/scene.h"

namespace splotchcl::scene_file {

// Whether the settings give the key of this label, such as "component.0.color.min".
using IsGiven = std::function<bool(const std::string& label)>;

// After settings have changed a scene: what was suggested for the scene before them, and nobody
// gave, gives way where it does not belong to the scene any more.
void give_way(const Scene& before, const Scene& suggested, const IsGiven& is_given, Scene& scene);

}  // namespace splotchcl::scene_file
