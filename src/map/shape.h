#pragma once

#include "splotchcl/map.h"
#include "splotchcl/map_settings.h"

namespace splotchcl {

// What cells the settings ask for. Throws UsageError where they contradict each other.
MapShape shape_of(const MapSettings& settings);

// Whether lines of sight begin at the map's center.
bool is_around_the_center(MapShape shape);
// Whether sums are made cell by cell, not drawn as a picture.
bool is_made_of_cells(MapShape shape);

}  // namespace splotchcl
