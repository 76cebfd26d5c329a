#include "load/press_look.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "load/derived_fields.h"
#include "load/suggest_camera.h"
#include "snapshot/field_names.h"
#include "snapshot/unit.h"

namespace splotchcl {
namespace {

// Decades that hold what a field can be, in its own unit.
struct Decades {
  double minimum, maximum;
};

// From gas that has cooled as space grew to that of clusters.
constexpr Decades temperatures_of_universe = {1e3, 3e7};  // K
// From the outskirts of a disc to the middle of a bulge.
constexpr Decades densities_of_galaxy = {3e5, 3e8};  // solar masses per cubic kpc
// From sheets to the cores of haloes.
constexpr Decades overdensities = {0.3, 3e4};  // in the mean density of the type in its box

void give_limits(const Decades& decades, FieldMap& map) {
  map.minimum = decades.minimum;
  map.maximum = decades.maximum;
  map.percentiles.reset();
}

// Of as many digits as one wants to read.
double rounded_limit(double value) {
  return round_to_decimals(value, decimals_for(value, 2));
}

bool is_in_universe(const SnapshotInfo& info) {
  return info.cosmology || info.redshift;
}

// What the field has for a kelvin, where that is known.
std::optional<double> per_kelvin(const Snapshot& snapshot, const ParticleTypeInfo& type,
                                 const std::string& heat) {
  if (heat == "temperature") return 1;
  const FieldInfo* const energy = find_field(type, heat);
  if (heat != "internal_energy" || energy == nullptr) return std::nullopt;
  const std::optional<double> unit = energy_unit_in_cgs(snapshot.info(), *energy);
  return unit ? std::optional(1 / temperature_of_one(*unit)) : std::nullopt;
}

// Whole powers of ten around limits found in one snapshot: those of the others are mostly the same.
void widen_to_decades(FieldMap& map) {
  if (!map.minimum || !map.maximum || map.scaling != Scaling::log) return;
  map.minimum = std::pow(10, std::floor(std::log10(*map.minimum) + 1e-6));
  map.maximum = std::pow(10, std::ceil(std::log10(*map.maximum) - 1e-6));
}

void color_gas(const Snapshot& snapshot, const ParticleTypeInfo& type, Component& component) {
  component.palette = "cosmos";
  const std::optional<double> kelvin = per_kelvin(snapshot, type, component.color.field);
  if (kelvin && is_in_universe(snapshot.info())) {
    const auto [coldest, hottest] = temperatures_of_universe;
    give_limits({rounded_limit(coldest * *kelvin), rounded_limit(hottest * *kelvin)},
                component.color);
  } else {
    widen_to_decades(component.color);
  }
}

// Of a type whose particles have one mass and fill a periodic box, in which distances grow with
// the universe: it stays the same.
std::optional<double> mean_density(const SnapshotInfo& info, const ParticleTypeInfo& type) {
  if (!info.box_size || !type.table_mass || !is_in_universe(info)) return std::nullopt;
  const BoxSides& sides = *info.box_size;
  const double volume = sides[0] * sides[1] * sides[2];
  if (!(volume > 0)) return std::nullopt;
  return static_cast<double>(type.count) * type.particles_per_drawn * *type.table_mass / volume;
}

void color_dark_matter(const SnapshotInfo& info, const ParticleTypeInfo& type,
                       Component& component) {
  component.palette = "abyss";
  const std::optional<double> mean = mean_density(info, type);
  if (!mean) return;
  give_limits({overdensities.minimum * *mean, overdensities.maximum * *mean}, component.color);
}

void color_disc(const SnapshotInfo& info, const ParticleTypeInfo& type, Component& component) {
  component.palette = "spiral";
  const std::optional<double> unit =
      ratio_of_known_units("M_sun kpc^-3", unit_of_matching_density(type), unit_factors(info));
  if (!unit) return;
  give_limits({densities_of_galaxy.minimum * *unit, densities_of_galaxy.maximum * *unit},
              component.color);
}

void draw_few_stars_as_points(const SnapshotInfo& info, Component& component) {
  constexpr int stars = 4;
  constexpr std::uint64_t few = 512;
  constexpr double point = 0.02;  // of the distance to the 64th neighbour
  constexpr double bright = 4;
  if (component.types != std::vector<int>{stars}) return;
  const ParticleTypeInfo& type = *info.find_type(stars);
  if (type.count >= few || find_field(type, "smoothing_length") != nullptr) return;
  component.size_factor = point;
  component.brightness = bright;
}

}  // namespace

Component in_press_look(Component component, const Snapshot& snapshot) {
  constexpr int gas = 0, halo = 1, stars = 4;
  const bool has_own_light = !component.color_vector.empty();
  if (has_own_light || component.color.field.empty()) return component;
  if (component.types.size() != 1) {
    component.palette = "cosmos";
    return component;
  }
  const ParticleTypeInfo& type = *snapshot.info().find_type(component.types.front());
  if (type.type == gas) {
    color_gas(snapshot, type, component);
  } else if (type.type == halo) {
    color_dark_matter(snapshot.info(), type, component);
  } else if (type.type == stars) {
    component.palette = "starlight";
    draw_few_stars_as_points(snapshot.info(), component);
  } else {
    color_disc(snapshot.info(), type, component);
  }
  return component;
}

bool dark_matter_carries_picture(const SnapshotInfo& info) {
  constexpr int halo = 1;
  constexpr std::uint64_t many_times = 4;
  const ParticleTypeInfo* const dark = info.find_type(halo);
  if (dark == nullptr) return false;
  std::uint64_t others = 0;
  for (const ParticleTypeInfo& type : info.types)
    others += type.type == halo ? 0 : type.count;
  return others > 0 && dark->count > many_times * others;
}

void finish_for_press(FinishSettings& finish) {
  finish.bloom = 0.14;
  finish.highlights = 1;
  finish.saturation = 1.1;
  finish.contrast = 1.5;
  finish.contrast_pivot = 1;
}

}  // namespace splotchcl
