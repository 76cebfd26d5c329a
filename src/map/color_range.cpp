#include "map/color_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/statistics.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

std::vector<double> values_with_a_place(const std::vector<float>& values, MapScaling scaling) {
  std::vector<double> usable;
  for (const float value : values) {
    if (!std::isfinite(value) || (scaling == MapScaling::log && !(value > 0))) continue;
    usable.push_back(static_cast<double>(value));
  }
  if (usable.empty()) usable = {1};
  return usable;
}

void check_limit(const std::optional<double>& said, const char* key, MapScaling scaling) {
  if (!said || scaling != MapScaling::log || *said > 0) return;
  throw UsageError(fmt::format(
      "key map.{}: found {}, expected a number > 0, since map.scaling is \"log\"", key, *said));
}

}  // namespace

ColorRange decide_color_range(const std::vector<float>& values, const MapSettings& settings,
                              double floor) {
  check_limit(settings.minimum, "min", settings.scaling);
  check_limit(settings.maximum, "max", settings.scaling);
  const bool has_floor = settings.scaling == MapScaling::log && !settings.minimum && floor > 0;

  std::vector<double> usable = values_with_a_place(values, settings.scaling);
  ColorRange range;
  range.low = settings.minimum.value_or(percentile(usable, settings.percentiles[0] / 100));
  range.high = settings.maximum.value_or(percentile(usable, settings.percentiles[1] / 100));
  if (has_floor && !settings.maximum && range.high < floor) {
    // Nearly all pixels lie below the floor: what there is lies in the few others.
    range.high = *std::max_element(usable.begin(), usable.end());
  }
  range.begins_at_floor = has_floor && range.low < floor && floor < range.high;
  if (range.begins_at_floor) range.low = floor;
  if (range.high >= range.low) return range;
  throw UsageError(fmt::format(
      "key map.max: found {:.6g}, below the palette's least value, {:.6g}, expected more",
      range.high, range.low));
}

}  // namespace splotchcl
