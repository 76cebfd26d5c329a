#pragma once

#include <cstddef>

#include "splotchcl/vector.h"

namespace splotchcl {

// The i-th vector of values in which the three of a vector lie side by side.
template <class Values>
Vec3 vector_at(const Values& values, std::size_t i) {
  return {{static_cast<double>(values[3 * i]), static_cast<double>(values[3 * i + 1]),
           static_cast<double>(values[3 * i + 2])}};
}

}  // namespace splotchcl
