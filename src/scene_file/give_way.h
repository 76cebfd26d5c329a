#pragma once

#include <functional>
#include <string>

#include "scene_file/check.h"
#include "splotchcl/scene.h"

namespace splotchcl::scene_file {

// Whether the settings give the key of this label, such as "component.0.color.min".
using IsGiven = std::function<bool(const std::string& label)>;

// After settings have changed a scene: what was suggested for the scene before them, and nobody
// gave, gives way where it does not belong to the scene any more.
void give_way(const Scene& before, const Scene& suggested, const IsGiven& is_given, Scene& scene);

// After settings have changed a scene: values that were there before go where those that the
// settings give exclude them, for what Key::excludes cannot say. Values that settings give are left
// to check_scene.
void replace_excluded(const IsGiven& is_given, Scene& scene, Origins& origins);

}  // namespace splotchcl::scene_file
