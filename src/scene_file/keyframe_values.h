#pragma once

#include <vector>

#include "scene_file/values.h"
#include "splotchcl/path.h"

namespace splotchcl::scene_file {

// An array of tables, each with a frame and keys of the scene.
ValueType<std::vector<Keyframe>> keyframes();

// [[x, y, z], ...], two at least.
ValueType<std::vector<Vec3>> points();

}  // namespace splotchcl::scene_file
