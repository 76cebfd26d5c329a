#include "map/color_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/statistics.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr std::array<double, 2> usual_percentiles = {1, 99.9};

double low_percentile(const MapSettings& settings, std::vector<double>& values) {
  return percentile(values, settings.percentiles.value_or(usual_percentiles)[0] / 100);
}
double high_percentile(const MapSettings& settings, std::vector<double>& values) {
  return percentile(values, settings.percentiles.value_or(usual_percentiles)[1] / 100);
}

// Of a logarithm only values above 0 have a place.
std::vector<double> usable_values(const std::vector<float>& values, bool is_log) {
  std::vector<double> usable;
  for (const float value : values) {
    if (!std::isfinite(value) || (is_log && !(value > 0))) continue;
    usable.push_back(static_cast<double>(value));
  }
  if (usable.empty()) usable = {1};
  return usable;
}

ColorRange percentiles_or(const MapSettings& settings, std::vector<double>& values) {
  ColorRange range;
  range.low = settings.minimum.value_or(low_percentile(settings, values));
  range.high = settings.maximum.value_or(high_percentile(settings, values));
  return range;
}

// Where half of the values that are not 0 lie within a hundredth of the farther limit, they would
// be a few steps of a palette's 256 apart.
bool has_decades(std::vector<double> values, const ColorRange& range) {
  constexpr double near = 0.01;
  values.erase(std::remove(values.begin(), values.end(), 0.0), values.end());
  if (values.empty()) return false;
  for (double& value : values)
    value = std::abs(value);
  return percentile(values, 0.5) < near * std::max(std::abs(range.low), std::abs(range.high));
}

ColorRange range_of_signed(const MapSettings& settings, std::vector<double> values) {
  ColorRange range = percentiles_or(settings, values);
  const bool is_open = !settings.minimum && !settings.maximum;
  if (is_open && range.low < 0 && range.high > 0) {
    range.high = std::max(-range.low, range.high);
    range.low = -range.high;
  }
  const MapScaling fitting = has_decades(values, range) ? MapScaling::asinh : MapScaling::linear;
  range.scaling = settings.scaling.value_or(fitting);
  return range;
}

void check_limit(const std::optional<double>& said, const char* key) {
  if (!said || *said > 0) return;
  throw UsageError(fmt::format(
      "key map.{}: found {}, expected a number > 0, since map.scaling is \"log\"", key, *said));
}

ColorRange range_of_logarithm(const MapSettings& settings, std::vector<double> values,
                              double floor) {
  ColorRange range = percentiles_or(settings, values);
  if (settings.minimum) return range;
  if (!settings.maximum && range.high < floor) {
    // Nearly all pixels lie below the floor: what there is lies in the few others.
    range.high = *std::max_element(values.begin(), values.end());
  }
  range.begins_at_floor = range.low < floor && floor < range.high;
  if (range.begins_at_floor) range.low = floor;
  return range;
}

// Whether the scaling that the settings leave open is to show values of 0 and below. Pixels of 0
// are empty.
bool is_signed(const MapSettings& settings, std::vector<double> values, double error) {
  if (settings.scaling) return *settings.scaling != MapScaling::log;
  const auto is_not_above_zero = [](const std::optional<double>& said) {
    return said && *said <= 0;
  };
  return is_not_above_zero(settings.minimum) || is_not_above_zero(settings.maximum) ||
         low_percentile(settings, values) < -error;
}

void check_order(double low, double high) {
  if (high >= low) return;
  throw UsageError(fmt::format(
      "key map.max: found {:.6g}, below the palette's least value, {:.6g}, expected more", high,
      low));
}

}  // namespace

void check_color_limits(const MapSettings& settings) {
  if (settings.scaling == MapScaling::log) {
    check_limit(settings.minimum, "min");
    check_limit(settings.maximum, "max");
  }
  if (!settings.minimum || !settings.maximum || *settings.minimum < *settings.maximum) return;
  throw UsageError(
      fmt::format("keys map.min and map.max: found {:.6g} and {:.6g}, expected the first to lie "
                  "below the second",
                  *settings.minimum, *settings.maximum));
}

ColorRange decide_color_range(const std::vector<float>& values, const MapSettings& settings,
                              double floor, double error) {
  check_color_limits(settings);
  const ColorRange range = is_signed(settings, usable_values(values, false), error)
                               ? range_of_signed(settings, usable_values(values, false))
                               : range_of_logarithm(settings, usable_values(values, true), floor);
  check_order(range.low, range.high);
  return range;
}

}  // namespace splotchcl
