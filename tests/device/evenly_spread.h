#pragma once

#include <vector>

namespace splotchcl::test {

// From the first to the last.
inline std::vector<float> evenly_spread(double first, double last, int count) {
  std::vector<float> values;
  for (int i = 0; i < count; ++i)
    values.push_back(static_cast<float>(first + (last - first) * i / (count - 1)));
  return values;
}

}  // namespace splotchcl::test
