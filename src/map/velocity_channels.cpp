#include "map/velocity_channels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "common/physical_constants.h"
#include "map/map_units.h"
#include "splotchcl/error.h"

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

}  // namespace splotchcl
