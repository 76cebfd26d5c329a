#include "map/written_lengths.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "common/words.h"
#include "map/named_place.h"
#include "map/sky.h"
#include "scene/constants.h"
#include "snapshot/unit.h"
#include "splotchcl/error.h"
#include "splotchcl/map.h"

namespace splotchcl {
namespace {

constexpr double degree = pi / 180;

// In radians; nothing for what has no unit of an angle.
std::optional<double> angle_of(const std::string& text) {
  const std::string unit = trimmed(unit_of_lengths(text));
  for (const char* const angle : {"deg", "arcmin", "arcsec", "rad"}) {
    if (unit == angle) return parse_unit(text, {}, "unit").in_cgs;
  }
  return std::nullopt;
}

double above_0(double length, const std::string& text, const std::string& what) {
  if (length > 0 && std::isfinite(length)) return length;
  throw UsageError(fmt::format("{}: found \"{}\", expected a length above 0", what, text));
}

double width_under(double angle, const Scene& scene, const Snapshot& snapshot,
                   const std::string& text) {
  if (scene.map.view == MapView::sky) return angle / degree;
  if (scene.map.distance.empty()) {
    throw UsageError(fmt::format(
        "key map.width: found \"{}\", an angle, expected a length; or set map.distance, "
        "or map.view to \"sky\"",
        text));
  }
  const double distance = read_map_length(distance_as_length(scene.map.distance, snapshot.info()),
                                          scene, snapshot, "key map.distance");
  return 2 * distance * std::tan(0.5 * std::min(angle, pi));
}

double read_width(const std::string& text, const Scene& scene, const Snapshot& snapshot) {
  const std::string what = "key map.width";
  if (const auto angle = angle_of(text))
    return above_0(width_under(*angle, scene, snapshot, text), text, what);
  if (scene.map.view == MapView::sky) {
    throw UsageError(fmt::format(
        "{}: found \"{}\" in a map of the sky, expected an angle, such as 2deg", what, text));
  }
  return above_0(read_map_length(text, scene, snapshot, what), text, what);
}

std::array<double, 2> read_shell(const std::string& text, const Scene& scene,
                                 const Snapshot& snapshot) {
  const std::string what = "key map.shell", unit = unit_of_lengths(text);
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos || text.find(',', comma + 1) != std::string::npos) {
    throw UsageError(
        fmt::format("{}: found \"{}\", expected two radii, such as 10,20Mpc", what, text));
  }
  const auto read = [&](std::string word) {
    word = trimmed(word);
    return read_map_length(unit_of_lengths(word).empty() ? word + unit : word, scene, snapshot,
                           what);
  };
  return {read(text.substr(0, comma)), read(text.substr(comma + 1))};
}

}  // namespace

Scene with_lengths_as_numbers(const Scene& scene, const Snapshot& snapshot) {
  Scene read = scene;
  MapSettings& map = read.map;
  for (const auto& [key, text] : scene.map.lengths_with_units) {
    if (key == "width") map.width = read_width(text, scene, snapshot);
    if (key == "depth") {
      map.depth =
          above_0(read_map_length(text, scene, snapshot, "key map.depth"), text, "key map.depth");
    }
    if (key == "center") map.center = read_place(text, scene, snapshot, "key map.center");
    if (key == "shell") map.shell = read_shell(text, scene, snapshot);
  }
  // Coordinates are told in the unit that was used.
  for (const char* const key : {"depth", "shell", "center", "width"}) {
    const auto found = scene.map.lengths_with_units.find(key);
    if (found == scene.map.lengths_with_units.end() || angle_of(found->second)) continue;
    if (scene.map.axis_unit.empty()) map.axis_unit = trimmed(unit_of_lengths(found->second));
  }
  map.lengths_with_units.clear();
  return read;
}

}  // namespace splotchcl
