#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "splotchcl/load.h"
#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"
#include "splotchcl/views.h"

// Maps: pictures whose values are a quantity in a unit (docs/maps.md).
namespace splotchcl {

// Where a map's middle is seen on the sky, in degrees, and how large a pixel is there.
struct SkyPlace {
  double right_ascension = 0, declination = 0;
  double pixel = 0;
  std::string projection = "TAN";  // as the FITS standard calls it
};

// What a map's cells are: squares in a plane, these in channels of velocity, pixels of a sphere
// by their numbers or as a picture of the sky, cubes, shells, or bins of two fields.
enum class MapShape { plane, velocities, healpix, sky, voxels, profile, histogram };

// Of voxels, of a profile or of a histogram: cells of equal width, or of equal ratio.
struct MapAxis {
  std::string name, unit;
  int cells = 0;
  double first = 0, last = 0;  // edges
  bool is_logarithmic = false;

  double edge(int i) const;
};

struct HealpixPixels {
  int nside = 0;
  HealpixOrder order = HealpixOrder::ring;
};

// The channels of a cube, which have the same width.
struct VelocityAxis {
  int channels = 0;
  double first = 0, step = 0;  // the middle of the first channel, and from one to the next
  std::string unit;            // "km/s"; "code_velocity" where unknown
};

// Values of width x height pixels, row 0 at the top; of a cube those of each channel, or of each z,
// in turn. Of a sphere or a profile there is one row.
struct Map {
  MapShape shape = MapShape::plane;
  int width = 0, height = 0;             // pixels
  std::optional<HealpixPixels> healpix;  // of a sphere
  std::vector<MapAxis> axes;  // of voxels, a profile or a histogram, the first to the right
  std::optional<std::array<double, 2>> shell;  // between which distances from the center it shows
  std::optional<VelocityAxis> velocity;        // of a cube
  // Not a number where a mean has too little matter to be known.
  std::vector<float> values;
  std::vector<float> effective_particles;  // empty unless it was asked for
  std::string quantity;                    // "mean of temperature, weighted by mass"
  std::string unit;                        // "Msun/pc^2"; "code_mass/code_length^2" where unknown

  // Where it lies. Lengths are in `length_unit`, to the right and upwards of `center`.
  std::string view;                        // "xy", "xz", "yz", "camera"
  std::string right_name, up_name;         // of the axes: "x", "y"; of a camera's "right", "up"
  std::string length_unit;                 // "kpc"; "code_length" where unknown
  double length_factor = 1;                // from the snapshot's lengths to these
  double pixel = 0;                        // side of a pixel
  Vec3 center = {{0, 0, 0}};               // x, y, z of the middle
  double center_right = 0, center_up = 0;  // its coordinates along the map's axes
  std::optional<SkyPlace> sky;             // where a distance was given

  // How exact: each sum over particles is within tolerance * max(sum, floor).
  double tolerance = 0;
  double floor = 0;  // of the column of the weights, in the snapshot's units
  // Below it the map's values are known to tolerance * value_floor, not to a part of themselves. 0
  // for means, which are not numbers there.
  double value_floor = 0;
  std::uint64_t particles = 0, images = 0, bad_particles = 0;

  int planes() const;  // of a cube; else 1
};

// A length as it is written, such as "4Mpc" or "4 Mpc", in the unit that the map's settings have
// lengths in: the snapshot's, in which a number alone is. `what` begins the message of the
// UsageError for a text that is none, or a snapshot that does not say its unit.
double read_map_length(const std::string& text, const Scene& scene, const Snapshot& snapshot,
                       const std::string& what);

// Draws the map that the scene's [map] says, each of its frames by `draw`. Throws as load does.
Map draw_map(const Scene& scene, const Snapshot& snapshot, const DrawFrame& draw,
             std::vector<std::string>& notes, const LoadProgress& progress = {});

// Throws UsageError for an ending that no map can be written as, DataError for a folder that cannot
// be written to.
void check_map_path(const std::filesystem::path& path);

// Before a map is drawn: refuses limits that cannot be, and a palette, a font or a placeholder that
// a figure would lack. Throws UsageError.
void check_map_output(const std::filesystem::path& path, const Scene& scene,
                      const SnapshotInfo& snapshot);

// By the ending: .fits, .hdf5, .npy and .exr hold the numbers, .pdf and pictures a figure with a
// color bar, by the scene's [map] and [finish]. The metadata is kept by .fits, .hdf5 and .exr.
// Returns notes, a line each: what a figure does not show, since it lies below its range or has no
// logarithm. Throws DataError.
std::vector<std::string> write_map(const std::filesystem::path& path, const Map& map,
                                   const Scene& scene, const SnapshotInfo& snapshot,
                                   const std::map<std::string, std::string>& metadata);

}  // namespace splotchcl
