#pragma once

#include "splotchcl/map.h"
#include "splotchcl/map_settings.h"
#include "splotchcl/scene.h"

namespace splotchcl {

// What cells the settings ask for. Throws UsageError where they contradict each other.
MapShape shape_of(const MapSettings& settings);

// Whether lines of sight begin at the map's center.
bool is_around_the_center(MapShape shape);
// Whether sums are made cell by cell, not drawn as a picture.
bool is_made_of_cells(MapShape shape);

// The component that map.component says. Throws UsageError where there is none.
const Component& component_of_map(const Scene& scene);

// The scene with this component alone, whose particles are counted and not seen: without what
// colors them in pictures, what is drawn over pictures, and an order.
Scene scene_of_numbers(const Scene& scene, const Component& component);

}  // namespace splotchcl
