#pragma once

#include <optional>

#include "map/map_units.h"
#include "splotchcl/map.h"
#include "splotchcl/map_settings.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// Where the map is seen on the sky; nothing without map.distance. `pixel` is its side in the units'
// lengths. Throws UsageError where the distance is no length and does not follow from the
// snapshot's redshift, or the map's lengths are not known.
std::optional<SkyPlace> decide_sky(const MapSettings& settings, const SnapshotInfo& snapshot,
                                   const MapUnits& units, double pixel);

}  // namespace splotchcl
