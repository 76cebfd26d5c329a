#pragma once

#include "scene_file/check.h"
#include "scene_file/give_way.h"
#include "splotchcl/scene.h"

namespace splotchcl::scene_file {

// After settings have changed a scene: values that were there before go where those that the
// settings give exclude them, for what Key::excludes cannot say. Values that settings give are left
// to check_scene.
void replace_excluded(const IsGiven& is_given, Scene& scene, Origins& origins);

}  // namespace splotchcl::scene_file
