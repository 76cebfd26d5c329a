#pragma once

#include <cstddef>
#include <string>

#include "splotchcl/particles.h"

namespace splotchcl {

// Minimum, maximum and mean are of the finite values; 0 where there are none.
struct FieldStatistics {
  std::size_t count = 0;  // all values, three for each vector
  std::size_t bad = 0;    // not-a-number or infinite
  std::size_t infinite = 0;
  double minimum = 0;
  double maximum = 0;
  double mean = 0;
};

// What the user should know of infinite values: few files have any, but many have numbers that are
// read as such.
std::string advice_on_infinite_values();

// Of all values of a column, in one pass. A uniform column counts as one value.
FieldStatistics find_statistics(const Column& values);

}  // namespace splotchcl
