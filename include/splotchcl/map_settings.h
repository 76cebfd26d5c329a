#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "splotchcl/vector.h"

namespace splotchcl {

// What is done with a quantity along each line of sight.
//   mean        weighted by mass, volume or a field
//   dispersion  the standard deviation about that mean, with the same weights
//   integral    of the quantity along the line
enum class MapStatistic { mean, dispersion, integral };

// From where a map is seen. The first letter's axis points to the right, the second's upwards.
//   camera  along the scene's camera, in parallel
//   sky     from the center, in all directions
enum class MapView { xy, xz, yz, camera, sky };

// How the pixels of a sphere are counted (Gorski et al. 2005, ApJ 622, 759).
enum class HealpixOrder { ring, nested };

// Where the middle of a map lies.
enum class MapCenter { box, mass, densest };

// How a figure's values v become places on its palette.
//   linear  v
//   log     log10(v); values <= 0 take the first color
//   asinh   asinh(v / softening), linear around 0
//   power   sign(v) |v|^exponent
enum class MapScaling { linear, log, asinh, power };

// What a map shows (docs/maps.md). Lengths are in the snapshot's unit.
struct MapSettings {
  std::string component;  // by name; empty: the first
  // "surface_density", "counts", "line_of_sight_velocity", or a field.
  std::string quantity = "surface_density";
  MapStatistic statistic = MapStatistic::mean;
  // Of means: "mass", "volume", or a field of values >= 0. Empty: mass; of slices, volume.
  std::string weight;
  bool slice = false;  // in the plane through the center, instead of along the line

  // A sum in so many channels of velocity along the line of sight, instead of one map; 0: a map.
  int channels = 0;
  // Of all channels together, in the snapshot's unit of velocity; unset: of all particles.
  std::optional<std::array<double, 2>> velocity_range;
  // > 0: lines are as wide as the thermal motion of particles of so many proton masses makes them.
  double line_mass = 0;

  // Cells other than the pixels of a plane: one of these at most.
  int healpix = 0;                        // pixels of a sphere: 12 NSIDE^2; 0: none
  std::array<int, 3> voxels = {0, 0, 0};  // along x, y and z; 0: none
  int profile = 0;                        // shells around the center; 0: none
  std::vector<std::string> histogram;     // two fields; empty: none

  HealpixOrder healpix_order = HealpixOrder::ring;
  // Radii of what counts in maps of spheres, and from the first to the last shell of a profile.
  std::optional<std::array<double, 2>> shell;
  bool tile = false;  // maps of spheres have every periodic image, not the nearest one alone
  std::array<int, 2> bins = {256, 256};                   // of a histogram
  std::optional<std::array<double, 2>> x_range, y_range;  // of its fields; unset: all there is

  MapView view = MapView::xy;
  std::optional<Vec3> center;
  MapCenter center_at = MapCenter::box;  // where there is no center
  std::optional<double> width, depth;    // unset: all of the box, or of the particles
  // "width", "depth", "center" or "shell" as it is written where it has a unit of its own. It
  // counts before the number.
  std::map<std::string, std::string> lengths_with_units;
  std::string axis_unit;         // of coordinates, such as "Mpc"; empty: what fits the width
  std::optional<bool> periodic;  // unset: where the particles lie in the snapshot's box
  // Smoothing lengths are multiplied by it, > 0. The components' size factors are for pictures.
  double size_factor = 1;

  std::string unit;  // of the map; empty: what the snapshot's units give
  // The snapshot's, where it does not say them.
  std::string length_unit, mass_unit, velocity_unit;
  double floor = 1e-3;  // of the mean of the weights' column, > 0
  bool noise = false;   // a second plane: the effective number of particles

  // Where the center is seen on the sky: from a distance such as "16.5 Mpc", or "redshift", the
  // snapshot's (empty: not on the sky), at [right ascension, declination] in degrees; up is north.
  std::string distance;
  std::array<double, 2> sky = {0, 0};

  // Of figures.
  // Unset: log; where there are values below 0, linear, or asinh where half of them would have
  // nearly one color.
  std::optional<MapScaling> scaling;
  std::optional<double> softening;  // > 0; unset: a thousandth of the farther limit, or less
  double exponent = 0.5;            // > 0
  // Unset: by percentiles, as docs/maps.md says.
  std::optional<double> minimum, maximum;
  std::optional<std::array<double, 2>> percentiles;  // unset: 1 and 99.9
  std::string palette = "viridis";
  std::vector<double> contours;  // values of the map
  int contour_count = 0;         // instead of them: so many, evenly in the palette
};

}  // namespace splotchcl
