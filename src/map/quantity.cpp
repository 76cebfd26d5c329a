#include "map/quantity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "map/map_units.h"
#include "map/shape.h"
#include "parallel/for_blocks.h"
#include "scene/constants.h"
#include "scene/particle_columns.h"
#include "splotchcl/error.h"
#include "splotchcl/periodic.h"

namespace splotchcl {
namespace {

constexpr const char* channels_key = "map.channels";
constexpr double boltzmann_in_erg_per_kelvin = 1.380649e-16;
// Lines are followed so many widths out: beyond lies less than 1e-11 of them.
constexpr double reach_of_lines = 5;

Column thermal_widths(const MapSettings& settings, const ComponentFields& fields, int type,
                      std::size_t count) {
  const double unit = velocity_in_cgs(settings, fields.snapshot_info(), type, "key map.line_mass");
  const Column temperature = fields.scalars("temperature", "map.line_mass");
  const double square =
      2 * boltzmann_in_erg_per_kelvin / (settings.line_mass * proton_mass_in_g * unit * unit);
  std::vector<float> widths(count);
  for (std::size_t i = 0; i < count; ++i)
    widths[i] = static_cast<float>(std::sqrt(square * static_cast<double>(temperature[i])));
  return Column::owning(std::move(widths));
}

// From the slowest to the fastest, with all of their lines.
std::array<double, 2> range_of(const VelocityChannels& channels, std::size_t count) {
  std::array<double, 2> range = {std::numeric_limits<double>::max(),
                                 std::numeric_limits<double>::lowest()};
  for (std::size_t i = 0; i < count; ++i) {
    if (!channels.is_good(i)) continue;
    const auto velocity = static_cast<double>(channels.velocity[i]);
    const double reach = reach_of_lines * static_cast<double>(channels.thermal[i]);
    range[0] = std::min(range[0], velocity - reach);
    range[1] = std::max(range[1], velocity + reach);
  }
  if (range[0] > range[1]) return {0, 1};
  if (range[0] == range[1]) return {range[0] - 0.5, range[1] + 0.5};
  return range;
}

}  // namespace

bool VelocityChannels::is_good(std::size_t i) const {
  return std::isfinite(velocity[i]) && (thermal.is_absent() || std::isfinite(thermal[i]));
}

double VelocityChannels::part(std::size_t i, int channel) const {
  const auto middle = static_cast<double>(velocity[i]);
  const double low = first_edge + channel * width, high = first_edge + (channel + 1) * width;
  const auto line = static_cast<double>(thermal[i]);
  if (line > 0) return 0.5 * (std::erf((high - middle) / line) - std::erf((low - middle) / line));
  // The last channel has its upper edge.
  const bool is_below = middle < high || (channel == count - 1 && middle == high);
  return middle >= low && is_below ? 1 : 0;
}

VelocityChannels read_channels(const MapSettings& settings, const MapGeometry& geometry,
                               const ComponentFields& fields, int type, std::size_t count) {
  VelocityChannels channels;
  if (settings.channels == 0) return channels;
  channels.count = settings.channels;
  channels.velocity = velocities_along(geometry.forward, fields, count, channels_key);
  if (settings.line_mass > 0) channels.thermal = thermal_widths(settings, fields, type, count);
  const std::array<double, 2> range =
      settings.velocity_range ? *settings.velocity_range : range_of(channels, count);
  channels.first_edge = range[0];
  channels.width = (range[1] - range[0]) / channels.count;
  return channels;
}

Column velocities_along(const Vec3& forward, const ComponentFields& fields, std::size_t count,
                        const char* key) {
  const Column velocity = fields.vectors("velocity", key);
  std::vector<float> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    double along = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      along += forward.a[axis] * static_cast<double>(velocity[3 * i + axis]);
    values[i] = static_cast<float>(along);
  }
  return Column::owning(std::move(values));
}

namespace {

// Positive for what moves away from the map's center: of each particle the image nearest to it.
Column velocities_from_center(const MapGeometry& geometry, const ComponentFields& fields,
                              std::size_t count, const char* key) {
  const Column velocity = fields.vectors("velocity", key), position = fields.positions();
  const Vec3 origin = fields.origin();
  std::vector<float> values(count);
  for_blocks(count, streamed_particles, [&](std::size_t first, std::size_t last) {
    const ColumnStretch places(position, 3 * first, 3 * last);
    const ColumnStretch velocities(velocity, 3 * first, 3 * last);
    for (std::size_t i = first; i < last; ++i) {
      double along = 0, square = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        double offset =
            static_cast<double>(places[3 * i + axis]) + origin.a[axis] - geometry.center.a[axis];
        if (geometry.box) offset = nearest_image(offset, (*geometry.box)[axis]);
        along += offset * static_cast<double>(velocities[3 * i + axis]);
        square += offset * offset;
      }
      values[i] = static_cast<float>(square > 0 ? along / std::sqrt(square) : 0);
    }
  });
  return Column::owning(std::move(values));
}

constexpr const char* quantity_key = "map.quantity";

bool is_column(const MapSettings& settings) {
  return settings.quantity == "surface_density" || settings.quantity == "counts";
}

// What a map needs masses for can often be had without.
void require_masses(const ComponentFields& fields, const std::string& what, const char* instead) {
  if (fields.masses_are_known()) return;
  throw UsageError(fmt::format("{}: {} needs masses, which its particles in {} do not have{}; {}",
                               fields.label(), what, fields.snapshot_info().files.front().string(),
                               why_left_out(fields.snapshot_info(), "mass"), instead));
}

// Volumes in cm^3 are beyond a float: in units of the first one that there is, where they are.
double unit_of_volumes(const ComponentFields& fields, const char* key, std::size_t count) {
  constexpr double large = 1e25;
  const Column mass = fields.masses(), density = fields.scalars("density", key);
  for (std::size_t i = 0; i < count; ++i) {
    const double volume = static_cast<double>(mass[i]) / static_cast<double>(density[i]);
    if (!std::isfinite(volume) || !(volume > 0)) continue;
    return volume < large && volume > 1 / large ? 1 : std::exp2(std::ilogb(volume));
  }
  return 1;
}

void weigh_by_volume(const ComponentFields& fields, const char* key, std::size_t count,
                     MapQuantity& quantity) {
  quantity.weight_unit = unit_of_volumes(fields, key, count);
  quantity.weight = fields.volumes(key, quantity.weight_unit);
}

Column weights(const std::string& name, const ComponentFields& fields, std::size_t count) {
  if (name == "constant") return Column::uniform(1);
  if (name == "mass" || name == "volume") {
    require_masses(fields, fmt::format("a mean weighted by {}", name),
                   "set map.weight to \"constant\", or to a field");
  }
  if (name == "mass" || name == "volume") return fields.masses();
  Column weight = fields.scalars(name, "map.weight");
  for (std::size_t i = 0; i < count; ++i) {
    if (!(weight[i] < 0)) continue;
    throw DataError(fmt::format(
        "key map.weight: found {} in the field \"{}\", expected weights >= 0", weight[i], name));
  }
  return weight;
}

Column values(const std::string& name, const MapGeometry& geometry, const ComponentFields& fields,
              std::size_t count) {
  if (name == "line_of_sight_velocity" && geometry.is_around_center)
    return velocities_from_center(geometry, fields, count, quantity_key);
  if (name == "line_of_sight_velocity")
    return velocities_along(geometry.forward, fields, count, quantity_key);
  return fields.scalars(name, quantity_key);
}

const char* counts_in(MapShape shape) {
  switch (shape) {
    case MapShape::voxels:
      return "particles per voxel";
    case MapShape::profile:
      return "particles per shell";
    case MapShape::histogram:
      return "particles per bin";
    case MapShape::plane:
    case MapShape::velocities:
    case MapShape::healpix:
    case MapShape::sky:
      break;
  }
  return "particles per pixel";
}

const char* density_in(MapShape shape) {
  switch (shape) {
    case MapShape::voxels:
    case MapShape::profile:
      return "density";
    case MapShape::healpix:
    case MapShape::sky:
      return "mass per solid angle";
    case MapShape::histogram:
      return "mass per bin";
    case MapShape::plane:
    case MapShape::velocities:
      break;
  }
  return "surface density";
}

MapQuantity column_of(const MapSettings& settings, const ComponentFields& fields) {
  if (settings.quantity == "counts") {
    return {
        MapQuantity::Kind::counts, Column::uniform(1), 1, {}, counts_in(shape_of(settings)), {}};
  }
  const char* const what = settings.slice ? "density in a plane" : density_in(shape_of(settings));
  require_masses(fields, fmt::format("a map of {}", what),
                 "set map.quantity to \"counts\", or to a field");
  return {MapQuantity::Kind::column, fields.masses(), 1, {}, what, {}};
}

MapQuantity read_unweighted(const MapSettings& settings, const MapGeometry& geometry,
                            const ComponentFields& fields, std::size_t count) {
  if (is_column(settings)) return column_of(settings, fields);
  MapQuantity quantity;
  quantity.value = values(settings.quantity, geometry, fields, count);
  if (settings.statistic == MapStatistic::integral) {
    require_masses(fields, "an integral", "set map.statistic to \"mean\"");
    quantity.kind = MapQuantity::Kind::integral;
    weigh_by_volume(fields, "map.statistic", count, quantity);
    quantity.description = fmt::format("integral of {} along the line of sight", settings.quantity);
    return quantity;
  }
  const bool is_mean = settings.statistic == MapStatistic::mean;
  // A slice of a field is its value in the plane: space counts there, not mass.
  const std::string weight =
      settings.weight.empty() ? (settings.slice ? "volume" : "mass") : settings.weight;
  quantity.kind = is_mean ? MapQuantity::Kind::mean : MapQuantity::Kind::dispersion;
  quantity.weight = weights(weight, fields, count);
  if (weight == "volume") weigh_by_volume(fields, "map.weight", count, quantity);
  quantity.description =
      fmt::format("{} of {}, weighted by {}{}", is_mean ? "mean" : "dispersion", settings.quantity,
                  weight, settings.slice ? ", in a plane" : "");
  return quantity;
}

}  // namespace

bool MapQuantity::is_good(std::size_t i) const {
  const bool needs_value = kind != Kind::column && kind != Kind::counts;
  return std::isfinite(weight[i]) && weight[i] >= 0 && (!needs_value || std::isfinite(value[i])) &&
         (channels.count == 0 || channels.is_good(i));
}

void check_channels(const MapSettings& settings) {
  if (settings.channels == 0) {
    if (!settings.velocity_range && settings.line_mass == 0) return;
    throw UsageError(fmt::format("key map.{}: found it without map.channels, expected both",
                                 settings.velocity_range ? "velocity_range" : "line_mass"));
  }
  const auto refuse = [](const char* key, const char* found, const char* expected) {
    throw UsageError(fmt::format("key map.channels: found it beside map.{} = {}, expected {}", key,
                                 found, expected));
  };
  if (!is_column(settings))
    refuse("quantity", settings.quantity.c_str(), "\"surface_density\" or \"counts\"");
  if (settings.slice) refuse("slice", "true", "a sum along the line of sight");
  if (settings.noise) refuse("noise", "true", "one of them");
  if (settings.velocity_range && !((*settings.velocity_range)[0] < (*settings.velocity_range)[1])) {
    throw UsageError(fmt::format("key map.velocity_range: found {} to {}, expected a rising range",
                                 (*settings.velocity_range)[0], (*settings.velocity_range)[1]));
  }
}

void check_quantity(const MapSettings& settings) {
  const MapShape shape = shape_of(settings);
  check_channels(settings);
  if (settings.tile && settings.quantity == "line_of_sight_velocity") {
    throw UsageError(
        "key map.tile: found true beside map.quantity = \"line_of_sight_velocity\", expected one "
        "of them: each image of a particle has another line of sight");
  }
  if (settings.quantity == "line_of_sight_velocity" &&
      (shape == MapShape::voxels || shape == MapShape::histogram)) {
    throw UsageError(
        "key map.quantity: found \"line_of_sight_velocity\", expected a field: these cells have no "
        "line of sight");
  }
  if (settings.slice && settings.quantity == "counts") {
    throw UsageError(
        "key map.slice: found true beside map.quantity = \"counts\", expected another quantity: a "
        "plane holds no particles");
  }
  if (settings.slice && settings.statistic == MapStatistic::integral) {
    throw UsageError(
        "key map.slice: found true beside map.statistic = \"integral\", expected \"mean\": in a "
        "plane there is nothing to integrate along");
  }
  const bool is_weighted = !is_column(settings) && settings.statistic != MapStatistic::integral;
  if (!settings.weight.empty() && !is_weighted) {
    throw UsageError(
        fmt::format("key map.weight: found \"{}\" for a sum, which has no weights, expected it "
                    "beside the mean or "
                    "the dispersion of a field",
                    settings.weight));
  }
  if (is_column(settings) && settings.statistic != MapStatistic::mean) {
    throw UsageError(fmt::format(
        "key map.statistic: found one for map.quantity = \"{}\", which is a sum, expected none; "
        "name a field as the quantity",
        settings.quantity));
  }
}

MapQuantity read_quantity(const MapSettings& settings, const MapGeometry& geometry,
                          const ComponentFields& fields, int type, std::size_t count) {
  MapQuantity quantity = read_unweighted(settings, geometry, fields, count);
  quantity.channels = read_channels(settings, geometry, fields, type, count);
  quantity.weight = fields.with_factors(quantity.weight);
  return quantity;
}

}  // namespace splotchcl
