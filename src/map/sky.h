#pragma once

#include <optional>
#include <string>

#include "map/map_units.h"
#include "splotchcl/map.h"
#include "splotchcl/map_settings.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// The distance of angular diameters to the snapshot's redshift in Mpc, by its own densities of
// matter and of the cosmological constant, with curvature for what is missing to 1, and no
// radiation (D. W. Hogg, astro-ph/9905116, equations 14 to 18). Throws UsageError, which names
// map.distance, where the snapshot has no cosmology or no Hubble parameter, or lies at redshift 0.
double angular_distance_in_mpc(const SnapshotInfo& snapshot);

// map.distance as a length with its unit: itself, or what "redshift" stands for.
std::string distance_as_length(const std::string& distance, const SnapshotInfo& snapshot);

// Where the map is seen on the sky; nothing without map.distance. `pixel` is its side in the units'
// lengths. Throws UsageError where the distance is no length and does not follow from the
// snapshot's redshift, or the map's lengths are not known.
std::optional<SkyPlace> decide_sky(const MapSettings& settings, const SnapshotInfo& snapshot,
                                   const MapUnits& units, double pixel);

}  // namespace splotchcl
