#pragma once

#include "splotchcl/scene.h"

namespace splotchcl {

// The component that map.component says. Throws UsageError where there is none.
const Component& component_of_map(const Scene& scene);

// The scene with this component alone, whose particles are counted and not seen: without what
// colors them in pictures, what is drawn over pictures, and an order.
Scene scene_of_numbers(const Scene& scene, const Component& component);

}  // namespace splotchcl
