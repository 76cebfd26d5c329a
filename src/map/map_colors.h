#pragma once

#include <vector>

#include "finish/ticks.h"
#include "map/color_range.h"
#include "splotchcl/map.h"
#include "splotchcl/map_settings.h"
#include "splotchcl/palette.h"

namespace splotchcl {

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
