#include "scene/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/hash.h"
#include "scene/particle_columns.h"
#include "scene/scalar_map.h"

namespace splotchcl {
namespace {

constexpr std::size_t sample_limit = 2000000;
constexpr double left_out_at_each_end = 0.005;

// One value for all is nobody's own.
ParticlePass pass_over_values(const Column& column, const ParticlePass& pass) {
  return column.is_array() ? pass : ParticlePass(column.is_uniform() ? 1 : 0);
}

// Of the scaled values that are finite; without any the lower end is above the upper one.
ValueRange range_of(const Column& column, Scaling scaling, const ParticleRun& run) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  ValueRange range = {infinity, -infinity};
  for_stretches(run, [&](std::size_t begin, std::size_t end) {
    const ColumnStretch stretch(column, begin, end);
    for (std::size_t i = begin; i < end; ++i) {
      const double value = scaled(static_cast<double>(stretch[i]), scaling);
      if (!std::isfinite(value)) continue;
      range.minimum = std::min(range.minimum, value);
      range.maximum = std::max(range.maximum, value);
    }
  });
  return range;
}

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

std::vector<double> sample_scaled(const Column& column, Scaling scaling, const ParticlePass& pass) {
  const std::size_t stride = sample_stride(column.size(), sample_limit);
  return pass_over_values(column, pass)
      .collect<double>([&](const ParticleRun& run, std::vector<double>& values) {
        for (std::size_t i = first_sampled(run, stride); i < run.end; i += stride) {
          const double value = scaled(static_cast<double>(column[i]), scaling);
          if (std::isfinite(value)) values.push_back(value);
        }
      });
}

std::vector<double> sample_scaled(const Column& column, Scaling scaling) {
  return sample_scaled(column, scaling, ParticlePass(column.size()));
}

std::optional<ValueRange> percentile_range(const Column& column, Scaling scaling, double low,
                                           double high, const ParticlePass& pass) {
  std::vector<double> values = sample_scaled(column, scaling, pass);
  if (values.empty()) return std::nullopt;
  ValueRange range = {percentile(values, low / 100), percentile(values, high / 100)};
  if (low > 0 && high < 100) return range;
  const std::vector<ValueRange> ends =
      pass_over_values(column, pass)
          .collect<ValueRange>([&](const ParticleRun& run, std::vector<ValueRange>& found) {
            found.push_back(range_of(column, scaling, run));
          });
  for (const ValueRange& end : ends) {
    if (low <= 0) range.minimum = std::min(range.minimum, end.minimum);
    if (high >= 100) range.maximum = std::max(range.maximum, end.maximum);
  }
  return range;
}

std::optional<ValueRange> bulk_range(const Column& column, Scaling scaling,
                                     const ParticlePass& pass) {
  std::vector<double> values = sample_scaled(column, scaling, pass);
  if (values.empty()) return std::nullopt;
  return ValueRange{percentile(values, left_out_at_each_end),
                    percentile(values, 1 - left_out_at_each_end)};
}

std::optional<ValueRange> bulk_range(const Column& column, Scaling scaling) {
  return bulk_range(column, scaling, ParticlePass(column.size()));
}

}  // namespace splotchcl
