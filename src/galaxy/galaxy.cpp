#include "splotchcl/galaxy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "galaxy/even_points.h"
#include "galaxy/light_map.h"
#include "galaxy/matter.h"
#include "generate/random.h"
#include "scene/ceil_divide.h"
#include "scene/constants.h"
#include "smoothing/smoothing_lengths.h"
#include "splotchcl/error.h"
#include "splotchcl/image_file.h"

namespace splotchcl {
namespace {

// One more particle; its smoothing length and velocity follow later.
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

// About the disk's axis, the way the galaxy turns.
Vec3 disk_axis(const GalaxySettings& settings) {
  return {{0, 0, settings.turns_clockwise ? -1.0 : 1.0}};
}

// The radius that holds a part, in (0, 1], of a Plummer sphere of radius 1, cut at 8.
double plummer_radius(double part) {
  constexpr double farthest = 8;
  const double all = std::pow(1 + 1 / (farthest * farthest), -1.5);
  return 1 / std::sqrt(std::pow(all * part, -2.0 / 3) - 1);
}

// That of a random part.
double plummer_radius(Random& random) {
  return plummer_radius(1 - random.uniform());
}

// Of length 1, at a right angle to a place, else in any direction.
Vec3 axis_across(const Vec3& place, Random& random) {
  const Vec3 axis = boost::qvm::cross(place, random.direction());
  const double length = boost::qvm::mag(axis);
  return length > 0 ? axis / length : Vec3{{0, 0, 1}};
}

// A factor on a star's light: log-normal with mean 1.
double star_brightness(Random& random, double spread = 0.8) {
  return std::exp(spread * random.normal() - spread * spread / 2);
}

// Evenly in a ball of radius 1.
Vec3 place_in_ball(Random& random) {
  return random.direction() * std::cbrt(random.uniform());
}

// A factor on heights.
double flare_at(double radius_kpc, const LightMap& map, const GalaxySettings& settings) {
  return std::exp(settings.flare * (radius_kpc / map.radius() - 0.5));
}

// The kinds of matter that a galaxy is made of: positions, colours and orbits. Each draws from a
// sequence of random numbers of its own, so that one does not change with another.

// Each particle has the colour of a pixel near the one above it, as if balls of particles of one
// colour, wider than a pixel, overlapped: if each had the colour of its own pixel, every column of
// particles would have one colour along z. It is the colour that is moved and not the particle, so
// that particles lie evenly.
GalaxyParticles make_gas(const LightMap& map, const BulgeProfile& bulge,
                         const GalaxySettings& settings) {
  Random random(settings.seed);
  GalaxyParticles gas;
  const Image& picture = map.picture();
  const double share = settings.disk_stars > 0 ? 1 - settings.disk_light : 1;
  const double mass = map.plane().area_of_pixel() / settings.cloud_points;
  const Vec3 axis = disk_axis(settings);
  PointsOfPixels points(settings.cloud_points);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      points.begin(x, y, random);
      for (int i = 0; i < settings.cloud_points; ++i) {
        const DiskPlane::Point pixel = points.place(i);
        const double quantile = normal_quantile(points.layer(i, random));
        const Vec3 aside = place_in_ball(random) * settings.cloud_radius_pixels;
        const DiskPlane::Point disk = map.plane().in_disk(pixel);
        const DiskPlane::Point lit =
            map.plane().in_disk({pixel[0] + aside.a[0], pixel[1] + aside.a[1]});
        const Light color = share * bulge.rest(map.at(lit), std::hypot(lit[0], lit[1]));
        if (!(mean(color) > 0)) continue;
        const double radius = std::hypot(disk[0], disk[1]);
        const double height = flare_at(radius, map, settings) * settings.gas_height_kpc * quantile;
        add_particle(gas, {{disk[0], disk[1], height}}, color, mass, axis, radius);
      }
    }
  }
  return gas;
}

// A particle's mass times its colour is what it absorbs: an optical depth times an area.
GalaxyParticles make_dust(const LightMap& map, const GalaxySettings& settings) {
  Random random(settings.seed + 4);
  GalaxyParticles dust;
  const double area = map.plane().area_of_pixel() / settings.dust_points;
  const Vec3 axis = disk_axis(settings);
  constexpr double least_depth = 0.01;  // less is not seen
  PointsOfPixels points(settings.dust_points);
  for (int y = 0; y < map.picture().height; ++y) {
    for (int x = 0; x < map.picture().width; ++x) {
      const double depth = map.dust().depth(x, y);
      points.begin(x, y, random);
      if (depth < least_depth) continue;
      for (int i = 0; i < settings.dust_points; ++i) {
        const DiskPlane::Point disk = map.plane().in_disk(points.place(i));
        const double radius = std::hypot(disk[0], disk[1]);
        const double height = flare_at(radius, map, settings) * settings.dust_height_kpc *
                              normal_quantile(points.layer(i, random));
        add_particle(dust, {{disk[0], disk[1], height}}, map.dust().opacity(), depth * area, axis,
                     radius);
      }
    }
  }
  return dust;
}

constexpr double color_spread = 0.2;

// A star's own light against the mean of its neighbourhood; 1 on average over stars.
Light star_color(const Light& around, Random& random) {
  const double brightness = star_brightness(random);
  const double warmth = std::clamp(color_spread * random.normal(), -0.6, 0.6);
  return {brightness * (1 + warmth) * around[0], brightness * around[1],
          brightness * (1 - warmth) * around[2]};
}

GalaxyParticles make_disk_stars(const LightMap& map, const BulgeProfile& bulge,
                                const GalaxySettings& settings) {
  Random random(settings.seed + 1);
  GalaxyParticles stars;
  const double width = settings.disk_width * map.radius();
  const double central_density =
      static_cast<double>(settings.disk_stars) / (2 * pi * width * width);
  const Vec3 axis = disk_axis(settings);
  const double jitter = jitter_between(settings.disk_stars);
  for (std::uint64_t i = 0; i < settings.disk_stars; ++i) {
    const Vec3 even = even_place(i, random, jitter);
    const double radius = width * std::sqrt(-2 * std::log1p(-even.a[0]));
    const double angle = 2 * pi * even.a[1];
    const Vec3 place = {
        {radius * std::cos(angle), radius * std::sin(angle),
         flare_at(radius, map, settings) * settings.disk_height_kpc * normal_quantile(even.a[2])}};
    const Light around = bulge.rest(map.at({place.a[0], place.a[1]}), radius);
    const Light color = star_color(settings.disk_light * around, random);
    // Where stars are few each stands for a larger area. Dark places have none.
    const double density = central_density * std::exp(-radius * radius / (2 * width * width));
    if (mean(color) > 0) add_particle(stars, place, color, 1 / density, axis, radius);
  }
  return stars;
}

GalaxyParticles make_bulge(const BulgeProfile& bulge, const GalaxySettings& settings) {
  Random random(settings.seed + 2);
  GalaxyParticles stars;
  if (!(mean(bulge.peak()) > 0)) return stars;
  const double mass = bulge.area() / static_cast<double>(settings.bulge_stars);
  const double jitter = jitter_between(settings.bulge_stars);
  for (std::uint64_t i = 0; i < settings.bulge_stars; ++i) {
    const Vec3 even = even_place(i, random, jitter);
    const double radius = settings.bulge_radius_kpc * plummer_radius(1 - even.a[0]);
    const double along = 2 * even.a[1] - 1, across = std::sqrt(1 - along * along);
    const double angle = 2 * pi * even.a[2];
    const Vec3 place = Vec3{{across * std::cos(angle), across * std::sin(angle),
                             settings.bulge_flattening * along}} *
                       radius;
    add_particle(stars, place, star_brightness(random) * bulge.peak(), mass,
                 axis_across(place, random), boost::qvm::mag(place));
  }
  return stars;
}

// Spread in radius like the galaxy's halo; their stars circle the galaxy together.
GalaxyParticles make_clusters(const LightMap& map, const GalaxySettings& settings) {
  Random random(settings.seed + 3);
  GalaxyParticles stars;
  if (settings.clusters == 0) return stars;
  constexpr double halo_fraction = 0.25;  // the Plummer radius of their positions, of the galaxy's
  constexpr double number_spread = 0.8, size_spread = 0.4;
  constexpr Light old_stars = {1.2, 1.0, 0.75};  // their mean is close to 1
  const double light_per_star = settings.cluster_light * map.total_light() /
                                (static_cast<double>(settings.clusters) * settings.cluster_stars);
  const double star_area = map.plane().area_of_pixel() / settings.cluster_stars;
  for (int cluster = 0; cluster < settings.clusters; ++cluster) {
    const double radius = halo_fraction * map.radius() * plummer_radius(random);
    const Vec3 center = random.direction() * radius;
    const Vec3 axis = axis_across(center, random);
    const double size = settings.cluster_radius_kpc * std::exp(size_spread * random.normal());
    const int count = std::max(
        1, static_cast<int>(settings.cluster_stars * std::exp(number_spread * random.normal())));
    for (int i = 0; i < count; ++i) {
      const Vec3 place = center + random.direction() * (size * plummer_radius(random));
      add_particle(stars, place, (star_brightness(random) * light_per_star / star_area) * old_stars,
                   star_area, axis, radius);
    }
  }
  return stars;
}

void check_above(double value, double limit, const char* what) {
  if (std::isfinite(value) && value > limit) return;
  throw UsageError(fmt::format("{}: found {}, expected a finite number > {}", what, value, limit));
}

void check_between(double value, double least, double largest, const char* what) {
  if (value >= least && value <= largest) return;
  throw UsageError(
      fmt::format("{}: found {}, expected a number from {} to {}", what, value, least, largest));
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
  if (gamma) check_above(*gamma, 0, "the picture's gamma");
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
