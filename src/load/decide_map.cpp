#include "load/decide_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "scene/scalar_map.h"
#include "scene/statistics.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// A limit of the scene on the scaled axis.
std::optional<double> scaled_limit(const std::optional<double>& limit, Scaling scaling,
                                   const std::string& label, const std::string& key) {
  if (!limit) return std::nullopt;
  const double value = scaled(*limit, scaling);
  if (!std::isfinite(value)) {
    throw UsageError(fmt::format(
        "{}: {} is {}, expected a number > 0, since the field is scaled by its logarithm; change "
        "the limit or the scaling",
        label, key, *limit));
  }
  return value;
}

// Of a range where the data give none: 1, or so much that large values differ by it.
double width_at(double value) {
  return std::max(1.0, 1e-3 * std::abs(value));
}

// Limits from the data, which must leave room for a limit that the scene gives.
ValueRange range_from_data(const Column& column, const FieldMap& map,
                           const ComponentFields& fields) {
  std::optional<ValueRange> bulk;
  if (map.percentiles) {
    bulk = percentile_range(column, map.scaling, (*map.percentiles)[0], (*map.percentiles)[1],
                            fields.pass());
  } else {
    bulk = bulk_range(column, map.scaling, fields.pass());
  }
  if (!bulk && fields.count() == 0) return {0, 1};
  if (!bulk) {
    fields.note(
        fmt::format("no particle has a {} that its scaling has a value for; all take the "
                    "range's lower end",
                    map.field));
    return {0, 1};
  }
  if (bulk->minimum < bulk->maximum) return *bulk;
  fields.note(fmt::format("{} is the same for all particles; they take the middle of its range",
                          map.field));
  const double width = width_at(bulk->minimum);
  return {bulk->minimum - 0.5 * width, bulk->maximum + 0.5 * width};
}

}  // namespace

ScalarMap decide_map(const FieldMap& map, const std::function<Column()>& read,
                     const ComponentFields& fields, const std::string& key) {
  ScalarMap decided;
  if (map.field.empty()) return decided;
  decided.scaling = map.scaling;
  const auto minimum = scaled_limit(map.minimum, map.scaling, fields.label(), key + ".min");
  const auto maximum = scaled_limit(map.maximum, map.scaling, fields.label(), key + ".max");
  if (minimum && maximum) {
    decided.minimum = *minimum;
    decided.maximum = *maximum;
    return decided;
  }
  const ValueRange data = range_from_data(read(), map, fields);
  decided.minimum = minimum.value_or(data.minimum);
  decided.maximum = maximum.value_or(data.maximum);
  if (decided.minimum < decided.maximum) return decided;
  // All data lie beyond the limit that is given: keep them all beyond it.
  if (minimum) {
    decided.maximum = *minimum + width_at(*minimum);
  } else {
    decided.minimum = decided.maximum - width_at(decided.maximum);
  }
  return decided;
}

}  // namespace splotchcl
