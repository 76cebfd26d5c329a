#include "map/map_colors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace splotchcl {
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
