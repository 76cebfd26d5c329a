#include "splotchcl/galaxy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "galaxy/kinds.h"
#include "galaxy/matter.h"
#include "scene/ceil_divide.h"
#include "smoothing/smoothing_lengths.h"
#include "splotchcl/error.h"
#include "splotchcl/image_file.h"

namespace splotchcl {
namespace {

void check_above(double value, double limit, const char* what) {
  if (std::isfinite(value) && value > limit) return;
  throw UsageError(fmt::format("{} is {}, expected a finite number > {}", what, value, limit));
}

void check_between(double value, double least, double largest, const char* what) {
  if (value >= least && value <= largest) return;
  throw UsageError(
      fmt::format("{} is {}, expected a number from {} to {}", what, value, least, largest));
}

// Throws UsageError that names the setting.
void check_settings(const GalaxySettings& s) {
  constexpr double most_stars = 1e9;
  // Beyond it, a disk's thickness is most of what a picture shows.
  check_between(s.detail, 0.01, 1000, "the detail");
  check_between(s.inclination_degrees, 0, 80, "the inclination in degrees");
  check_between(s.position_angle_degrees, -360, 360, "the position angle in degrees");
  if (s.radius_pixels) check_above(*s.radius_pixels, 0, "the galaxy's radius in pixels");
  check_above(s.size_kpc, 0, "the picture's size in kpc");
  check_between(s.threshold, 0, 1e6, "the threshold in deviations of the sky");
  check_between(s.border_fade, 0, 0.5, "the part of the picture over which its border fades");
  check_above(s.star_contrast, 1, "the contrast of foreground stars");
  check_between(s.gas_height_kpc, 0, s.size_kpc, "the gas's height in kpc");
  check_between(s.cloud_points, 1, 1000, "the number of gas particles in a pixel");
  check_between(s.cloud_radius_pixels, 0, 1000, "a cloud's radius in pixels");
  check_between(s.dust, 0, 100, "the factor on the dust");
  check_between(s.dust_height_kpc, 0, s.size_kpc, "the dust's height in kpc");
  check_between(s.dust_points, 1, 1000, "the number of dust particles in a pixel");
  check_between(s.flare, 0, 10, "how much the disk flares");
  check_between(static_cast<double>(s.disk_stars), 0, most_stars, "the number of disk stars");
  check_above(s.disk_width, 0, "the width of the stars' disk");
  check_between(s.disk_height_kpc, 0, s.size_kpc, "the height of the stars' disk in kpc");
  check_between(s.disk_light, 0, 1, "the disk stars' part of the light");
  check_between(static_cast<double>(s.bulge_stars), 0, most_stars, "the number of bulge stars");
  check_above(s.bulge_radius_kpc, 0, "the bulge's radius in kpc");
  check_between(s.bulge_flattening, 0, 1, "the bulge's flattening");
  check_between(s.bulge_light, 0, 1, "the bulge's part of the light");
  check_between(s.clusters, 0, 1e6, "the number of globular clusters");
  check_between(s.cluster_stars, 1, 1e6, "the number of stars in a globular cluster");
  check_above(s.cluster_radius_kpc, 0, "the radius of a globular cluster in kpc");
  check_between(s.cluster_light, 0, 1, "the globular clusters' part of the light");
}

constexpr int neighbors = 24;
// Of gas, dust and stars that are not in clusters: their lengths reach to where 64 would be.
const double length_factor = std::cbrt(64.0 / neighbors);
// The picture shows nothing smaller than a pixel: smaller clouds would show how particles lie.
constexpr double least_length_pixels = 2.5;
constexpr int smallest_side = 16;  // of a picture in which a border tells what sky is

void find_lengths(GalaxyParticles& particles, double factor = 1, double least_length = 0) {
  const Column position(nullptr, particles.position.data(), particles.position.size());
  const Column lengths =
      find_smoothing_lengths(position, particles.count(), std::nullopt, neighbors);
  particles.smoothing_length.assign(lengths.data(), lengths.data() + lengths.size());
  for (float& length : particles.smoothing_length)
    length = static_cast<float>(std::max(factor * static_cast<double>(length), least_length));
}

std::uint64_t times(std::uint64_t count, double detail) {
  return static_cast<std::uint64_t>(std::llround(static_cast<double>(count) * detail));
}
int times(int count, double detail) {
  return std::max(1, static_cast<int>(std::lround(count * detail)));
}

GalaxySettings with_detail(GalaxySettings settings) {
  settings.cloud_points = times(settings.cloud_points, settings.detail);
  settings.dust_points = times(settings.dust_points, settings.detail);
  settings.disk_stars = times(settings.disk_stars, settings.detail);
  settings.bulge_stars = times(settings.bulge_stars, settings.detail);
  settings.detail = 1;
  return settings;
}

void find_velocities(GalaxyParticles& particles, const RotationCurve& curve) {
  particles.velocity.resize(particles.position.size());
  for (std::size_t i = 0; i < particles.count(); ++i) {
    const double angular_speed =
        curve.angular_speed(static_cast<double>(particles.orbit_radius[i])) * myr_per_kpc_s_km;
    const Vec3 velocity = angular_speed * boost::qvm::cross(vector_at(particles.orbit_axis, i),
                                                            vector_at(particles.position, i));
    for (std::size_t axis = 0; axis < 3; ++axis)
      particles.velocity[3 * i + axis] = static_cast<float>(velocity.a[axis]);
  }
}

void check_picture(const Image& picture) {
  if (std::min(picture.width, picture.height) >= smallest_side) return;
  throw DataError("the picture has " + std::to_string(picture.width) + "x" +
                  std::to_string(picture.height) + " pixels, expected at least " +
                  std::to_string(smallest_side) + " a side to tell a galaxy from its sky");
}

}  // namespace

void add_particle(GalaxyParticles& particles, const Vec3& place, const Light& color, double mass,
                  const Vec3& orbit_axis, double orbit_radius) {
  for (std::size_t i = 0; i < 3; ++i) {
    particles.position.push_back(static_cast<float>(place.a[i]));
    particles.color.push_back(static_cast<float>(color[i]));
    particles.orbit_axis.push_back(static_cast<float>(orbit_axis.a[i]));
  }
  particles.mass.push_back(static_cast<float>(mass));
  particles.orbit_radius.push_back(static_cast<float>(orbit_radius));
}

Vec3 disk_axis(const GalaxySettings& settings) {
  return {{0, 0, settings.turns_clockwise ? -1.0 : 1.0}};
}

Galaxy make_galaxy(const Image& picture, const GalaxySettings& given, double file_pixels) {
  check_settings(given);
  const GalaxySettings settings = with_detail(given);
  check_settings(settings);
  check_picture(picture);
  const LightMap map(picture, settings, file_pixels);
  const BulgeProfile bulge(map, settings);
  Galaxy galaxy;
  galaxy.center = {map.center()[0] * file_pixels, map.center()[1] * file_pixels};
  galaxy.sky = mean(map.sky().level);
  galaxy.noise = map.sky().noise;
  galaxy.pixels_of_stars = map.pixels_of_stars();
  galaxy.size_kpc = settings.size_kpc;
  galaxy.pixel_size_kpc = map.plane().pixel_size();
  galaxy.gas = make_gas(map, bulge, settings);
  galaxy.disk = make_disk_stars(map, bulge, settings);
  galaxy.bulge = make_bulge(bulge, settings);
  galaxy.clusters = make_clusters(map, settings);
  galaxy.dust = make_dust(map, settings);
  const double least_length = least_length_pixels * map.plane().pixel_size();
  find_lengths(galaxy.gas, length_factor, least_length);
  find_lengths(galaxy.disk, length_factor);
  find_lengths(galaxy.bulge, length_factor);
  find_lengths(galaxy.clusters);
  find_lengths(galaxy.dust, length_factor, least_length);
  for (GalaxyParticles* kind :
       {&galaxy.gas, &galaxy.disk, &galaxy.bulge, &galaxy.clusters, &galaxy.dust})
    find_velocities(*kind, settings.rotation);
  return galaxy;
}

Galaxy read_galaxy(const std::filesystem::path& path, const GalaxySettings& settings,
                   std::optional<double> gamma) {
  check_settings(settings);
  const ImageFileInfo info = read_image_info(path);
  LinearImageOptions options;
  options.gamma = gamma;
  options.longest_side = galaxy_picture_limit;
  try {
    const Image picture = read_linear_image(path, options);
    const int longest = std::max(info.width, info.height);
    const int square = ceil_divide(longest, galaxy_picture_limit);
    return make_galaxy(picture, settings, square);
  } catch (const DataError& error) {
    const std::string text = error.what();
    if (text.rfind(path.string(), 0) == 0) throw;
    throw DataError(path.string() + ": " + text);
  }
}

}  // namespace splotchcl
