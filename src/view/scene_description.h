#pragma once

#include <set>
#include <string>

#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"

namespace splotchcl::view {

// What a page is told of the scene when it opens, as JSON: the value of every key that it may set,
// its components with the fields that they could show, and all palettes with their colors; and
// whether the picture may take the window's size and shape.
std::string describe_scene(const Scene& opened, const Snapshot& snapshot, bool fills_window);

// The same of a component that may be added to the scene: its keys are without "component.N.".
std::string describe_component(const Component& component, const Snapshot& snapshot);

// What another look, of which this is the scene, would set of the opened one: its light, and each
// component that is of the same particles.
std::string describe_look(const Scene& opened, const Scene& look);

// What keyframes of the scene set, of what a page may set.
std::set<std::string> keys_of_keyframes(const Scene& scene);
// The values of such keys, as JSON.
std::string describe_values(const Scene& scene, const std::set<std::string>& keys);

}  // namespace splotchcl::view
