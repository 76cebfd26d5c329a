#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "splotchcl/rotation_curve.h"

// A galaxy of three dimensions from one picture of it. Lengths are in kpc, speeds in km/s,
// the disk lies in z = 0 around the origin, x to the right and y up in the picture, z towards
// the observer of a disk seen face-on.
namespace splotchcl {

struct Image;

// What the picture does not tell. Parts are from 0 to 1.
struct GalaxySettings {
  // Where the galaxy is in the picture.
  std::optional<std::array<double, 2>> center;  // pixels from the left and top; unset: found
  double inclination_degrees = 0;               // 0 face-on, below 80
  // Of the disk's longest diameter, from up counter-clockwise.
  double position_angle_degrees = 0;
  std::optional<double> radius_pixels;  // unset: as far as the picture's farthest corner
  double size_kpc = 30;                 // of the picture's longer side

  // What is the galaxy's light and what is not.
  double threshold = 2;       // over the sky, in deviations of its noise: half of such light counts
  double border_fade = 0.06;  // of the shorter side, over which light fades at the border
  bool removes_stars = true;  // points of light that the Milky Way's stars make
  double star_contrast = 2.5;  // of such a point, against the median around it

  // Gas: a cloud for each bright pixel.
  double gas_height_kpc = 0.12;  // standard deviation of the clouds' heights
  int cloud_points = 4;          // particles for each pixel
  double cloud_radius_pixels = 1.6;

  // Dust: what makes lanes dark, and hides the middle of a disk seen from its edge.
  double dust = 1;                // factor on its optical depth; 0: none
  double dust_height_kpc = 0.05;  // standard deviation of its heights
  int dust_points = 3;            // particles for each pixel

  // The disk flares: heights at radius r of the galaxy's radius R are exp(flare (r / R - 1/2))
  // times those given here. 0: the same everywhere.
  double flare = 1;

  // Stars of the disk.
  std::uint64_t disk_stars = 300000;
  double disk_width = 0.35;  // standard deviation across, of the galaxy's radius
  double disk_height_kpc = 0.2;
  double disk_light = 0.2;  // their part of the picture's light

  // The bulge, a Plummer sphere a little flattened.
  std::uint64_t bulge_stars = 150000;
  double bulge_radius_kpc = 0.7;
  double bulge_flattening = 0.8;  // height over width
  double bulge_light = 0.6;       // its part of the light at the centre

  // Globular clusters.
  int clusters = 150;
  int cluster_stars = 2000;  // the median of a random number
  double cluster_radius_kpc = 0.012;
  double cluster_light = 0.005;  // of the picture's

  // Factor on the numbers of all particles but those of clusters.
  double detail = 1;

  bool turns_clockwise = false;  // as seen in the picture
  RotationCurve rotation = RotationCurve::flat();
  std::uint64_t seed = 1;
};

// Particles of one kind; vectors have 3 values for each.
struct GalaxyParticles {
  std::vector<float> position, velocity;
  // Linear red, green and blue >= 0; of dust what it absorbs of them, relative to green.
  std::vector<float> color;
  // The area, in kpc^2, that its colour covers; of dust times its optical depth in green.
  std::vector<float> mass;
  // Reaches to neighbour 24 of its kind, 1.4 times as far but in clusters; of gas and dust at least
  // 2.5 pixels.
  std::vector<float> smoothing_length;
  std::vector<float> orbit_axis;    // unit vector: it circles the centre about this axis,
  std::vector<float> orbit_radius;  // with the angular speed of this radius
  std::size_t count() const { return mass.size(); }
};

struct Galaxy {
  GalaxyParticles gas;       // Gadget type 0
  GalaxyParticles disk;      // 2
  GalaxyParticles bulge;     // 3
  GalaxyParticles clusters;  // 4
  GalaxyParticles dust;      // 5
  // What was decided about the picture, in pixels of the file.
  std::array<double, 2> center = {0, 0};
  double sky = 0, noise = 0;  // mean of the channels, linear light
  std::uint64_t pixels_of_stars = 0;
  double size_kpc = 0;        // of the picture's longer side
  double pixel_size_kpc = 0;  // of the squares that clouds are made from
};

// Pictures are averaged down to this many pixels on their longer side before anything else.
constexpr int galaxy_picture_limit = 1024;

// `picture` is linear light. `file_pixels` is how many pixels of the file, on a side, one pixel
// of it is the average of; positions in the settings count those of the file. The sum over
// particles of mass * color, seen along z, is the picture's light integrated over area: with
// weight "mass" and a reference column of 1, light without absorption shows the picture again.
// The same settings give the same particles. Throws UsageError for settings out of range,
// DataError for a picture without a galaxy.
Galaxy make_galaxy(const Image& picture, const GalaxySettings& settings, double file_pixels = 1);

// From a file of any size, averaged down as said above. `gamma` as in LinearImageOptions. Throws
// also as read_linear_image does.
Galaxy read_galaxy(const std::filesystem::path& picture, const GalaxySettings& settings,
                   std::optional<double> gamma = std::nullopt);

// A scene file that draws the galaxy in this snapshot, with a tone curve that holds from any side:
// seen from its edge the disk is far brighter than its picture.
std::string galaxy_scene(const Galaxy& galaxy, const std::filesystem::path& snapshot);

// Gadget HDF5 with Coordinates, Velocities, ParticleIDs, Masses, SmoothingLength, Color (of dust
// Opacity), OrbitAxis and OrbitRadius. Appears under its name only when complete. Throws DataError.
void write_galaxy(const std::filesystem::path& path, const Galaxy& galaxy);

}  // namespace splotchcl
