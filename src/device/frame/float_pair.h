#pragma once

#include <cmath>

#include "device/frame/shared.h"

namespace splotchcl {

// Volatile, since GCC 12 at -O3 takes the way to float and back for nothing.
inline float nearest_float(double value) {
  const volatile float nearest = static_cast<float>(value);
  return nearest;
}

// What is left of a number beyond single precision goes to the low part; of an infinite one nothing
// is.
inline shared::FloatPair pair_of(double value) {
  const float high = nearest_float(value);
  if (!std::isfinite(high)) return {high, 0};
  return {high, nearest_float(value - static_cast<double>(high))};
}

}  // namespace splotchcl
