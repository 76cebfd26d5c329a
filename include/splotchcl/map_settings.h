#pragma once

#include <array>
#include <optional>
#include <string>

#include "splotchcl/light_model.h"
#include "splotchcl/vector.h"

namespace splotchcl {

// What is done with a quantity along each line of sight.
//   mean        weighted by mass, volume or a field
//   dispersion  the standard deviation about that mean, with the same weights
//   integral    of the quantity along the line
enum class MapStatistic { mean, dispersion, integral };

// From where a map is seen. The first letter's axis points to the right, the second's upwards.
enum class MapView { xy, xz, yz, camera };

// Where the middle of a map lies.
enum class MapCenter { box, mass, densest };

// What a map shows (docs/maps.md). Lengths are in the snapshot's unit.
struct MapSettings {
  std::string component;  // by name; empty: the first
  // "surface_density", "counts", "line_of_sight_velocity", or a field.
  std::string quantity = "surface_density";
  MapStatistic statistic = MapStatistic::mean;
  // Of means: "mass", "volume", or a field of values >= 0. Empty: mass; of slices, volume.
  std::string weight;
  bool slice = false;  // in the plane through the center, instead of along the line

  MapView view = MapView::xy;
  std::optional<Vec3> center;
  MapCenter center_at = MapCenter::box;  // where there is no center
  std::optional<double> width, depth;    // unset: all of the box, or of the particles
  std::optional<bool> periodic;          // unset: where the snapshot has a periodic box

  std::string unit;  // of the map; empty: what the snapshot's units give
  // The snapshot's, where it does not say them.
  std::string length_unit, mass_unit, velocity_unit;
  double floor = 1e-3;  // of the mean of the weights' column, > 0
  bool noise = false;   // a second plane: the effective number of particles

  Scaling scaling = Scaling::log;  // of pictures
  std::optional<double> minimum, maximum;
  std::array<double, 2> percentiles = {1, 99.9};
  std::string palette = "viridis";
};

}  // namespace splotchcl
