#include "map/sky.h"

#include <fmt/format.h>

#include <cmath>

#include "scene/constants.h"
#include "snapshot/unit.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr double speed_of_light_in_km_per_s = 299792.458;

[[noreturn]] void refuse(const std::string& found) {
  throw UsageError(
      fmt::format("key map.distance: found \"redshift\", but {}, expected a length with its unit, "
                  "such as \"16.5 Mpc\"",
                  found));
}

// The comoving distance along the line of sight over that of Hubble: the integral of
// da / (a^2 E(a)), by Simpson's rule in the root of a, in which it is smooth down to a = 0.
double line_of_sight_distance(const Cosmology& cosmology, double curvature) {
  constexpr int steps = 1000;
  const double first = std::sqrt(cosmology.scale_factor), step = (1 - first) / steps;
  const auto integrand = [&](double root) {
    const double a = root * root;
    return 2 /
           std::sqrt(cosmology.omega_matter + curvature * a + cosmology.omega_lambda * a * a * a);
  };
  double sum = integrand(first) + integrand(1);
  for (int i = 1; i < steps; ++i)
    sum += (i % 2 == 1 ? 4 : 2) * integrand(first + i * step);
  return sum * step / 3;
}

double across_the_line_of_sight(double distance, double curvature) {
  const double root = std::sqrt(std::abs(curvature));
  if (root * distance < 1e-6) return distance;
  return (curvature > 0 ? std::sinh(root * distance) : std::sin(root * distance)) / root;
}

}  // namespace

double angular_distance_in_mpc(const SnapshotInfo& snapshot) {
  if (!snapshot.cosmology) refuse("the snapshot says no cosmology");
  if (!snapshot.hubble_parameter) refuse("the snapshot says no Hubble parameter");
  const Cosmology& cosmology = *snapshot.cosmology;
  const double a = cosmology.scale_factor;
  constexpr double rounding = 1e-6;
  if (!(a < 1 - rounding)) refuse("the snapshot is of redshift 0, from where nothing is far");
  const double curvature = 1 - cosmology.omega_matter - cosmology.omega_lambda;
  const double hubble_distance = speed_of_light_in_km_per_s / (100 * *snapshot.hubble_parameter);
  const double distance = line_of_sight_distance(cosmology, curvature);
  const double angular = a * hubble_distance * across_the_line_of_sight(distance, curvature);
  if (!(angular > 0 && std::isfinite(angular))) refuse("its cosmology has none");
  return angular;
}

namespace {

double distance_in_cm(const std::string& text, const SnapshotInfo& snapshot) {
  const Unit megaparsec = parse_unit("Mpc", {}, "unit");
  if (text == "redshift") return angular_distance_in_mpc(snapshot) * megaparsec.in_cgs;
  const Unit distance = parse_unit(text, {}, "key map.distance");
  if (same_dimension(distance, megaparsec) && distance.in_cgs > 0) return distance.in_cgs;
  throw UsageError(fmt::format(
      "key map.distance: found \"{}\", expected a length with its unit, such as \"16.5 Mpc\", or "
      "\"redshift\"",
      text));
}

}  // namespace

std::string distance_as_length(const std::string& distance, const SnapshotInfo& snapshot) {
  if (distance != "redshift") return distance;
  return fmt::format("{} Mpc", angular_distance_in_mpc(snapshot));
}

// In the tangent plane at a distance D a length s is seen as the tangent s / D: the projection TAN
// of the FITS standard, whose pixels are equal there.
std::optional<SkyPlace> decide_sky(const MapSettings& settings, const SnapshotInfo& snapshot,
                                   const MapUnits& units, double pixel) {
  if (settings.distance.empty()) {
    if (settings.sky == MapSettings().sky || settings.view == MapView::sky) return std::nullopt;
    throw UsageError(
        "key map.sky: found it without map.distance, expected both: from where the map is seen");
  }
  const double distance = distance_in_cm(settings.distance, snapshot);
  if (units.length_in_cgs == 0) {
    throw UsageError(fmt::format(
        "key map.distance: found \"{}\", but the map's lengths are in {}, which is not known; set "
        "map.length_unit",
        settings.distance, units.length_name));
  }
  SkyPlace sky;
  sky.right_ascension = settings.sky[0];
  sky.declination = settings.sky[1];
  sky.pixel = pixel * units.length_in_cgs / distance * 180 / pi;
  return sky;
}

}  // namespace splotchcl
