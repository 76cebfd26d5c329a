#include "view/field_histogram.h"

#include <algorithm>

#include "scene/scalar_map.h"
#include "scene/statistics.h"

namespace splotchcl::view {

FieldHistogram field_histogram(const Column& column, Scaling scaling, std::size_t bins) {
  FieldHistogram histogram;
  const std::vector<double> values = sample_scaled(column, scaling);
  if (values.empty()) return histogram;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  histogram.minimum = unscaled(*low, scaling);
  histogram.maximum = unscaled(*high, scaling);
  histogram.counts.resize(bins);
  const double width = *high - *low;
  for (const double value : values) {
    const double place = width > 0 ? (value - *low) / width * static_cast<double>(bins) : 0;
    ++histogram.counts[std::min(bins - 1, static_cast<std::size_t>(place))];
  }
  return histogram;
}

}  // namespace splotchcl::view
