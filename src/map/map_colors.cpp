#include "map/map_colors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "map/color_range.h"

namespace splotchcl {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

MapColors::MapColors(const std::vector<float>& values, const MapSettings& settings, double floor)
    : exponent_(settings.exponent) {
  const ColorRange range = decide_color_range(values, settings, floor);
  scaling_ = range.scaling;
  low_ = range.low;
  high_ = range.high;
  softening_ = decide_softening(settings);
}

// A thousandth of the limit that is farther from 0, brought down to a power of ten.
double MapColors::decide_softening(const MapSettings& settings) const {
  if (settings.softening) return *settings.softening;
  const double farther = std::max(std::abs(low_), std::abs(high_));
  return farther > 0 ? std::pow(10.0, std::floor(std::log10(farther / 1e3))) : 1;
}

double MapColors::scaled(double value) const {
  switch (scaling_) {
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
  switch (scaling_) {
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
  if (high_ == low_ || (scaling_ == MapScaling::log && value <= 0)) return 0;
  return (scaled(value) - scaled(low_)) / (scaled(high_) - scaled(low_));
}

std::vector<double> MapColors::even_values(int count) const {
  std::vector<double> values;
  for (int i = 1; i <= count; ++i)
    values.push_back(unscaled(scaled(low_) + i * (scaled(high_) - scaled(low_)) / (count + 1)));
  return values;
}

// 0 and powers of ten on both sides of it, where asinh is like a logarithm.
std::vector<Tick> MapColors::symmetric_ticks(int most, bool superscripts) const {
  std::vector<Tick> ticks = {{place(0), 0, "0"}};
  const int first = static_cast<int>(std::ceil(std::log10(softening_) - 1e-9));
  const int last =
      static_cast<int>(std::floor(std::log10(std::max(std::abs(low_), std::abs(high_))) + 1e-9));
  const int sides = low_ < 0 && high_ > 0 ? 2 : 1;
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
  const bool has_decades = std::max(std::abs(low_), std::abs(high_)) > 20 * softening_;
  std::vector<Tick> ticks;
  if (scaling_ == MapScaling::asinh && has_decades) {
    ticks = symmetric_ticks(most, superscripts);
  } else {
    ScalarMap axis;
    const bool is_log = scaling_ == MapScaling::log;
    axis.scaling = is_log ? Scaling::log : Scaling::linear;
    axis.minimum = is_log ? std::log10(low_) : low_;
    axis.maximum = is_log ? std::log10(high_) : high_;
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
