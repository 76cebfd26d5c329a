#pragma once

#include <vector>

#include "finish/ticks.h"
#include "splotchcl/map.h"
#include "splotchcl/map_settings.h"
#include "splotchcl/palette.h"

namespace splotchcl {

// The values that take the first and the last color of a figure's palette.
struct ColorRange {
  MapScaling scaling = MapScaling::log;
  double low = 0, high = 1;
  bool begins_at_floor = false;  // where a percentile would have been lower
};

// Throws UsageError for limits that the scaling does not have, or out of order, whatever the map.
void check_color_limits(const MapSettings& settings);

// Limits that the settings leave open are percentiles of the values: of a logarithm not below the
// floor, where maps hold errors rather than values; of values of both signs, where both are open,
// as far below 0 as above it, so that 0 has the palette's middle. A scaling that is left open is
// what shows such values, as far as they lie farther below 0 than `error`, that of values of 0.
// Throws UsageError as check_color_limits does, and where a limit lies beyond a percentile that
// stands for the other.
ColorRange decide_color_range(const std::vector<float>& values, const MapSettings& settings,
                              double floor, double error);

// From a map's values to the places 0 to 1 of a palette, and to the marks of its bar.
class MapColors {
 public:
  // Limits are those of decide_color_range. Throws UsageError as it does.
  MapColors(const std::vector<float>& values, const MapSettings& settings, double floor = 0,
            double error = 0);

  const ColorRange& range() const { return range_; }
  // Not clamped; not a number for a value without one. Of a logarithm 0 for values <= 0.
  double place(double value) const;
  // Of places that are even in [0, 1], without its ends.
  std::vector<double> even_values(int count) const;
  std::vector<Tick> ticks(int most, bool superscripts) const;

 private:
  double scaled(double value) const;
  double unscaled(double value) const;
  double decide_softening(const MapSettings& settings) const;
  std::vector<Tick> symmetric_ticks(int most, bool superscripts) const;

  ColorRange range_;
  double exponent_, softening_;
};

}  // namespace splotchcl
