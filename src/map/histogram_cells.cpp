#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "map/cell_map.h"
#include "map/cell_sums.h"
#include "map/map_units.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// The particles of one of the fields, and its bins.
struct BinnedField {
  Column values;
  MapAxis axis;

  double at(std::size_t i) const { return static_cast<double>(values[i]); }
  // None outside of them.
  std::optional<int> bin_of(std::size_t i) const {
    const double value = at(i);
    if (!(value >= axis.first && value <= axis.last)) return std::nullopt;
    const double part = axis.is_logarithmic
                            ? std::log(value / axis.first) / std::log(axis.last / axis.first)
                            : (value - axis.first) / (axis.last - axis.first);
    return std::clamp(static_cast<int>(part * axis.cells), 0, axis.cells - 1);
  }
};

std::array<double, 2> range_of(const BinnedField& field, const Amounts& amounts,
                               std::size_t count) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < count; ++i) {
    if (!amounts.is_good(i)) continue;
    low = std::min(low, field.at(i));
    high = std::max(high, field.at(i));
  }
  if (!(low <= high)) return {1, 10};
  if (low < high) return {low, high};
  // All have one value.
  return low == 0 ? std::array<double, 2>{-0.5, 0.5}
                  : std::array<double, 2>{low - 0.5 * std::abs(low), low + 0.5 * std::abs(low)};
}

// Logarithmic where no value is 0 or below.
void set_range(const CellMatter& matter, const Amounts& amounts,
               const std::optional<std::array<double, 2>>& said, const char* key,
               BinnedField& field) {
  const std::array<double, 2> range = said ? *said : range_of(field, amounts, matter.matter.count);
  if (!(range[1] > range[0])) {
    throw UsageError(
        fmt::format("key {}: found {} to {}, expected a rising range", key, range[0], range[1]));
  }
  field.axis.first = range[0];
  field.axis.last = range[1];
  field.axis.is_logarithmic = range[0] > 0;
}

BinnedField read_field(const CellMatter& matter, const ComponentFields& fields, int type,
                       std::size_t which) {
  const MapSettings& settings = matter.settings;
  const std::string& name = settings.histogram[which];
  BinnedField field;
  field.values = fields.scalars(name, "map.histogram");
  field.axis.name = name;
  field.axis.unit = unit_of_field(name, settings, fields.snapshot_info(), type);
  field.axis.cells = settings.bins[which];
  return field;
}

}  // namespace

CellMap draw_histogram(const CellMatter& matter, const ComponentFields& fields, int type) {
  BinnedField x = read_field(matter, fields, type, 0), y = read_field(matter, fields, type, 1);
  const Amounts amounts(
      matter.quantity, matter.matter.count, matter.weight_unit,
      [&](std::size_t i) { return std::isfinite(x.at(i)) && std::isfinite(y.at(i)); });
  set_range(matter, amounts, matter.settings.x_range, "map.x_range", x);
  set_range(matter, amounts, matter.settings.y_range, "map.y_range", y);
  const auto width = static_cast<std::size_t>(x.axis.cells),
             height = static_cast<std::size_t>(y.axis.cells);
  CellSums sums(amounts.kinds(), width * height);
  std::size_t outside = 0;
  for (std::size_t i = 0; i < matter.matter.count; ++i) {
    if (!amounts.is_good(i)) continue;
    const auto column = x.bin_of(i), row = y.bin_of(i);
    if (!column || !row) {
      ++outside;
      continue;
    }
    const std::size_t cell =
        (height - 1 - static_cast<std::size_t>(*row)) * width + static_cast<std::size_t>(*column);
    for (std::size_t kind = 0; kind < amounts.kinds(); ++kind)
      sums.kinds[kind][cell] += amounts(i, kind);
  }

  CellMap map;
  map.values = values_of(
      sums, amounts, [](std::size_t) { return 1.0; }, 0);
  map.width = x.axis.cells;
  map.height = y.axis.cells;
  map.axes = {x.axis, y.axis};
  map.images = matter.matter.count;
  map.bad = amounts.bad();
  if (outside > 0) {
    map.notes.push_back(fmt::format(
        "keys map.x_range and map.y_range: {} of {} particles have values outside of them", outside,
        matter.matter.count));
  }
  return map;
}

}  // namespace splotchcl
