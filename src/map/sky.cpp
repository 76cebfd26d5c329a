#include "map/sky.h"

#include <fmt/format.h>

#include "map/unit.h"
#include "scene/constants.h"
#include "splotchcl/error.h"

namespace splotchcl {

// In the tangent plane at a distance D a length s is seen as the tangent s / D: the projection TAN
// of the FITS standard, whose pixels are equal there.
std::optional<SkyPlace> decide_sky(const MapSettings& settings, const MapUnits& units,
                                   double pixel) {
  if (settings.distance.empty()) {
    if (settings.sky == MapSettings().sky) return std::nullopt;
    throw UsageError(
        "key map.sky: found it without map.distance, expected both: from where the map is seen");
  }
  const Unit distance = parse_unit(settings.distance, {}, "key map.distance");
  const Unit centimeter = parse_unit("cm", {}, "unit");
  if (!same_dimension(distance, centimeter) || !(distance.in_cgs > 0)) {
    throw UsageError(fmt::format(
        "key map.distance: found \"{}\", expected a length with its unit, such as \"16.5 Mpc\"",
        settings.distance));
  }
  if (units.length_in_cgs == 0) {
    throw UsageError(fmt::format(
        "key map.distance: found \"{}\", but the map's lengths are in {}, which is not known; set "
        "map.length_unit",
        settings.distance, units.length_name));
  }
  SkyPlace sky;
  sky.right_ascension = settings.sky[0];
  sky.declination = settings.sky[1];
  sky.pixel = pixel * units.length_in_cgs / distance.in_cgs * 180 / pi;
  return sky;
}

}  // namespace splotchcl
