#include "snapshot/field_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace splotchcl {

FieldStatistics find_statistics(const Column& values) {
  FieldStatistics result;
  result.count = values.is_uniform() ? 1 : values.size();
  float minimum = std::numeric_limits<float>::infinity();
  float maximum = -std::numeric_limits<float>::infinity();
  double sum = 0;
  for (std::size_t i = 0; i < result.count; ++i) {
    const float value = values[i];
    if (!std::isfinite(value)) {
      ++result.bad;
      if (std::isinf(value)) ++result.infinite;
      continue;
    }
    minimum = std::min(minimum, value);
    maximum = std::max(maximum, value);
    sum += static_cast<double>(value);
  }
  if (result.bad == result.count) return result;
  result.minimum = static_cast<double>(minimum);
  result.maximum = static_cast<double>(maximum);
  result.mean = sum / static_cast<double>(result.count - result.bad);
  return result;
}

std::string advice_on_infinite_values() {
  return "numbers beyond single precision, which ends at 3.4e38, are read as infinite: store them "
         "in a larger unit, as masses in Msun in place of g";
}

}  // namespace splotchcl
