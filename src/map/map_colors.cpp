#include "map/map_colors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

MapColors::MapColors(const std::vector<float>& values, const MapSettings& settings, double floor,
                     double error)
    : range_(decide_color_range(values, settings, floor, error)),
      exponent_(settings.exponent),
      softening_(decide_softening(settings)) {}

// A thousandth of the limit that is farther from 0, brought down to a power of ten.
double MapColors::decide_softening(const MapSettings& settings) const {
  if (settings.softening) return *settings.softening;
  const double farther = std::max(std::abs(range_.low), std::abs(range_.high));
  return farther > 0 ? std::pow(10.0, std::floor(std::log10(farther / 1e3))) : 1;
}

double MapColors::scaled(double value) const {
  switch (range_.scaling) {
    case MapScaling::linear:
      return value;
    case MapScaling::log:
      return std::log10(value);
    case MapScaling::asinh:
      return std::asinh(value / softening_);
    case MapScaling::power:
      return std::copysign(std::pow(std::abs(value), exponent_), value);
  }
  return value;
}

double MapColors::unscaled(double value) const {
  switch (range_.scaling) {
    case MapScaling::linear:
      return value;
    case MapScaling::log:
      return std::pow(10.0, value);
    case MapScaling::asinh:
      return softening_ * std::sinh(value);
    case MapScaling::power:
      return std::copysign(std::pow(std::abs(value), 1 / exponent_), value);
  }
  return value;
}

double MapColors::place(double value) const {
  if (std::isnan(value)) return nan;
  if (range_.high == range_.low || (range_.scaling == MapScaling::log && value <= 0)) return 0;
  return (scaled(value) - scaled(range_.low)) / (scaled(range_.high) - scaled(range_.low));
}

std::vector<double> MapColors::even_values(int count) const {
  std::vector<double> values;
  for (int i = 1; i <= count; ++i)
    values.push_back(unscaled(scaled(range_.low) +
                              i * (scaled(range_.high) - scaled(range_.low)) / (count + 1)));
  return values;
}

// 0 and powers of ten on both sides of it, where asinh is like a logarithm.
std::vector<Tick> MapColors::symmetric_ticks(int most, bool superscripts) const {
  std::vector<Tick> ticks = {{place(0), 0, "0"}};
  const int first = static_cast<int>(std::ceil(std::log10(softening_) - 1e-9));
  const int last = static_cast<int>(
      std::floor(std::log10(std::max(std::abs(range_.low), std::abs(range_.high))) + 1e-9));
  const int sides = range_.low < 0 && range_.high > 0 ? 2 : 1;
  const int step = std::max(1, (sides * (last - first + 1)) / std::max(1, most - 1));
  for (int exponent = last; exponent >= first; --exponent) {
    const double decade = std::pow(10.0, exponent);
    for (const double value : {-decade, decade}) {
      const bool has_number = (last - exponent) % step == 0;
      ticks.push_back({place(value), value, has_number ? number_label(value, superscripts) : ""});
    }
  }
  return ticks;
}

std::vector<Tick> MapColors::ticks(int most, bool superscripts) const {
  const bool has_decades = std::max(std::abs(range_.low), std::abs(range_.high)) > 20 * softening_;
  std::vector<Tick> ticks;
  if (range_.scaling == MapScaling::asinh && has_decades) {
    ticks = symmetric_ticks(most, superscripts);
  } else {
    ScalarMap axis;
    const bool is_log = range_.scaling == MapScaling::log;
    axis.scaling = is_log ? Scaling::log : Scaling::linear;
    axis.minimum = is_log ? std::log10(range_.low) : range_.low;
    axis.maximum = is_log ? std::log10(range_.high) : range_.high;
    ticks = ticks_of(axis, most, superscripts);
    for (Tick& tick : ticks)
      tick.position = place(tick.value);
  }
  constexpr double slack = 1e-9;
  ticks.erase(std::remove_if(
                  ticks.begin(), ticks.end(),
                  [](const Tick& t) { return !(t.position >= -slack && t.position <= 1 + slack); }),
              ticks.end());
  return ticks;
}

}  // namespace splotchcl
