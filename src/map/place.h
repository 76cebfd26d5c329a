#pragma once

#include <optional>
#include <string>
#include <vector>

#include "map/map_units.h"
#include "splotchcl/map.h"
#include "splotchcl/map_settings.h"
#include "splotchcl/scene.h"
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

// A place that the data say: "box", "mass", "densest", or "halo=5", by its number as select.halo
// has it. As maps have them (map.center_at); a halo's is its center of mass, of all types that the
// scene's components draw. Throws UsageError, which `what` begins, for other words.
Vec3 find_named_place(const std::string& words, const Scene& scene, const Snapshot& snapshot,
                      const std::string& what, std::vector<std::string>& notes);

// Where X,Y,Z lies, each a length as read_map_length() has it, in the unit that the last has.
Vec3 read_place(const std::string& text, const Scene& scene, const Snapshot& snapshot,
                const std::string& what);

// "Mpc" of "25,25,25 Mpc" or of "4Mpc"; nothing of numbers alone.
std::string unit_of_lengths(const std::string& lengths);

// The scene with map.width, depth, center and shell as numbers, where they are written with units;
// an angle as what is seen under it from map.distance, or in degrees for a map of the sky. Throws
// UsageError.
Scene with_lengths_as_numbers(const Scene& scene, const Snapshot& snapshot);

}  // namespace splotchcl
