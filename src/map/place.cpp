#include "map/place.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "common/words.h"
#include "load/components.h"
#include "load/missing_sizes.h"
#include "map/geometry.h"
#include "map/shape.h"
#include "scene/constants.h"
#include "snapshot/field_names.h"
#include "snapshot/unit.h"
#include "splotchcl/error.h"
#include "splotchcl/map.h"

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

namespace {

const std::string halo_words = "halo=";

[[noreturn]] void refuse(const std::string& words, const std::string& what) {
  throw UsageError(fmt::format(
      "{}: found \"{}\", expected X,Y,Z, such as 25,25,25Mpc, or box, mass, densest or halo=NUMBER",
      what, words));
}

std::uint64_t halo_number(const std::string& words, const std::string& what) {
  const auto number = parse_whole_number(std::string_view(words).substr(halo_words.size()));
  if (!number) refuse(words, what);
  return *number;
}

// One that draws what all of the scene's components of its own snapshot draw.
Component joined_component(const Scene& scene) {
  Component joined = scene.components.front();
  for (const Component& component : scene.components) {
    if (!component.snapshot.empty() || component.placement.moves()) continue;
    for (const int type : component.types) {
      const bool is_there = std::count(joined.types.begin(), joined.types.end(), type) > 0;
      if (!is_there) joined.types.push_back(type);
    }
  }
  return joined;
}

// No sizes but where they tell what is dense: to find them may take long.
MapMatter read_matter_of_place(const ComponentFields& fields, MapCenter center) {
  MapMatter matter;
  matter.count = fields.count();
  matter.before_selecting = fields.count_before_selecting();
  matter.origin = fields.origin();
  matter.position = fields.positions();
  matter.smoothing_length = Column::uniform(1);
  if (fields.masses_are_known()) matter.mass = fields.with_factors(fields.masses());
  if (center == MapCenter::densest) matter.density = fields.scalars("density", "center");
  return matter;
}

Scene scene_of_place(const Scene& scene, const std::string& words, const std::string& what) {
  Scene one = scene;
  const bool is_halo = words.rfind(halo_words, 0) == 0;
  const bool is_densest = words == "densest";
  if (!is_halo && !is_densest && words != "mass" && words != "box") refuse(words, what);
  one.map.center.reset();
  one.map.width.reset();
  one.map.lengths_with_units.clear();
  one.map.view = MapView::xy;
  one.map.center_at = is_densest                   ? MapCenter::densest
                      : is_halo || words == "mass" ? MapCenter::mass
                                                   : MapCenter::box;
  Component component = is_densest ? scene.components.front() : joined_component(scene);
  if (is_halo) component.select.halo = halo_number(words, what);
  return scene_of_numbers(one, component);
}

}  // namespace

std::string unit_of_lengths(const std::string& lengths) {
  const std::size_t comma = lengths.rfind(','), first = comma == std::string::npos ? 0 : comma + 1;
  const std::size_t last = lengths.find_first_not_of(' ', first);
  if (last == std::string::npos) return {};
  const std::size_t unit = lengths.find_first_not_of(' ', end_of_number(lengths, last));
  return unit == std::string::npos ? "" : lengths.substr(unit);
}

Vec3 read_place(const std::string& text, const Scene& scene, const Snapshot& snapshot,
                const std::string& what) {
  const std::string unit = unit_of_lengths(text);
  std::istringstream words(text);
  std::vector<double> place;
  for (std::string word; std::getline(words, word, ',');) {
    word = trimmed(word);
    if (unit_of_lengths(word).empty()) word += unit;
    place.push_back(read_map_length(word, scene, snapshot, what));
  }
  if (place.size() != 3) refuse(text, what);
  return {{place[0], place[1], place[2]}};
}

Vec3 find_named_place(const std::string& words, const Scene& scene, const Snapshot& snapshot,
                      const std::string& what, std::vector<std::string>& notes) {
  require_chosen_components(scene);
  const Scene one = scene_of_place(scene, words, what);
  const Component& component = one.components.front();
  const PeriodicRegion region = find_region(one, component, snapshot, notes);
  OpenComponents open(one, snapshot, missing_sizes(one, {}), notes, region.box);
  ComponentFields& fields = open.fields().front();
  fields.select();
  if (fields.count() == 0) {
    throw UsageError(
        fmt::format("{}: found \"{}\", but select and exclude leave none of {} particles, expected "
                    "some to find "
                    "the place by; give it as X,Y,Z",
                    what, words, fields.count_before_selecting()));
  }
  return decide_geometry(one, read_matter_of_place(fields, one.map.center_at), region).center;
}

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
