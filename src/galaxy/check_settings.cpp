#include "galaxy/check_settings.h"

#include <fmt/format.h>

#include <cmath>

#include "splotchcl/error.h"

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

}  // namespace

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

}  // namespace splotchcl
