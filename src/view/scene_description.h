#pragma once

#include <string>

#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"

namespace splotchcl::view {

// What a page is told of the scene when it opens, as JSON: the value of every key that it may set,
// its components with the fields that they could show, and all palettes with their colors; and
// whether the picture may take the window's size and shape.
std::string describe_scene(const Scene& opened, const Snapshot& snapshot, bool fills_window);

}  // namespace splotchcl::view
