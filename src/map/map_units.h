#pragma once

#include <string>
#include <utility>
#include <vector>

#include "map/quantity.h"
#include "snapshot/unit.h"
#include "splotchcl/map_settings.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// A unit as it is called, and what it is. Where it is not known its name is that of code units.
struct NamedUnits {
  std::string name;
  bool is_known = false;
  Unit unit;
};

// The units of a map's values and of its lengths.
struct MapUnits {
  std::string name;   // of the values
  double factor = 1;  // from the snapshot's units to these
  std::string length_name;
  double length_factor = 1;  // from the snapshot's lengths to these
  double length_in_cgs = 0;  // of one of these; 0: not known
};

// Of a mass per volume in the units that the file names for the type's; empty where it does not.
std::string name_of_density(const ParticleTypeInfo& type);

// A length such as "4Mpc" in the snapshot's unit of length, for a type that it has; a number alone
// is in that already. `what` begins the UsageError for what is none, or cannot be converted.
double length_in_snapshot(const std::string& text, const MapSettings& settings,
                          const SnapshotInfo& snapshot, int type, const std::string& what);

// What the unit of a field is called.
std::string unit_of_field(const std::string& name, const MapSettings& settings,
                          const SnapshotInfo& snapshot, int type);
// The snapshot's unit of velocity. `what` begins the UsageError where it does not say it.
double velocity_in_cgs(const MapSettings& settings, const SnapshotInfo& snapshot, int type,
                       const std::string& what);
// What velocities are told in, and from the snapshot's to that: km/s, or code units.
std::pair<std::string, double> told_velocity(const MapSettings& settings,
                                             const SnapshotInfo& snapshot, int type);

// `width` is the map's, in the snapshot's lengths, which decides what coordinates are told in. Of
// types that are there, at least one. Throws UsageError where their units differ, for a unit
// that is none, that has another dimension, or that is asked for where the snapshot's is not known.
MapUnits decide_units(const MapSettings& settings, const SnapshotInfo& snapshot,
                      const std::vector<int>& types, MapQuantity::Kind kind, double width);

}  // namespace splotchcl
