#include "scene/statistics.h"

#include <algorithm>
#include <cmath>

#include "scene/hash.h"
#include "scene/scalar_map.h"
#include "scene/streamed_column.h"

namespace splotchcl {
namespace {

constexpr std::size_t sample_limit = 2000000;
constexpr double left_out_at_each_end = 0.005;

}  // namespace

std::size_t sampled_index(std::size_t first, std::size_t stride, std::size_t count) {
  const std::size_t range = std::min(stride, count - first);
  return first + static_cast<std::size_t>(hash_of(first / stride) % range);
}

double percentile(std::vector<double>& values, double fraction) {
  const double place = fraction * static_cast<double>(values.size() - 1);
  const std::size_t below = static_cast<std::size_t>(std::floor(place));
  const auto lower = values.begin() + static_cast<std::ptrdiff_t>(below);
  std::nth_element(values.begin(), lower, values.end());
  if (below + 1 >= values.size()) return *lower;
  const double upper = *std::min_element(lower + 1, values.end());
  return *lower + (place - static_cast<double>(below)) * (upper - *lower);
}

std::vector<double> sample_scaled(const Column& column, Scaling scaling) {
  const std::size_t count = column.is_uniform() ? 1 : column.size();
  std::vector<double> values;
  for (std::size_t i = 0; i < count; i += sample_stride(count, sample_limit)) {
    const double value = scaled(static_cast<double>(column[i]), scaling);
    if (std::isfinite(value)) values.push_back(value);
  }
  return values;
}

std::optional<ValueRange> percentile_range(const Column& column, Scaling scaling, double low,
                                           double high) {
  std::vector<double> values = sample_scaled(column, scaling);
  if (values.empty()) return std::nullopt;
  ValueRange range = {percentile(values, low / 100), percentile(values, high / 100)};
  if (low > 0 && high < 100) return range;
  for_stretches(column.is_uniform() ? 1 : column.size(), [&](std::size_t begin, std::size_t end) {
    const ColumnStretch stretch(column, begin, end);
    for (std::size_t i = begin; i < end; ++i) {
      const double value = scaled(static_cast<double>(stretch[i]), scaling);
      if (!std::isfinite(value)) continue;
      if (low <= 0) range.minimum = std::min(range.minimum, value);
      if (high >= 100) range.maximum = std::max(range.maximum, value);
    }
  });
  return range;
}

std::optional<ValueRange> bulk_range(const Column& column, Scaling scaling) {
  std::vector<double> values = sample_scaled(column, scaling);
  if (values.empty()) return std::nullopt;
  return ValueRange{percentile(values, left_out_at_each_end),
                    percentile(values, 1 - left_out_at_each_end)};
}

}  // namespace splotchcl
