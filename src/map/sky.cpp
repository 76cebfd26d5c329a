#include "map/sky.h"

#include <fmt/format.h>

#include "map/angular_distance.h"
#include "scene/constants.h"
#include "snapshot/unit.h"
#include "splotchcl/error.h"

namespace splotchcl {

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

// In the tangent plane at a distance D a length s is seen as the tangent s / D: the projection TAN
// of the FITS standard, whose pixels are equal there.
std::optional<SkyPlace> decide_sky(const MapSettings& settings, const SnapshotInfo& snapshot,
                                   const MapUnits& units, double pixel) {
  if (settings.distance.empty()) {
    if (settings.sky == MapSettings().sky) return std::nullopt;
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
