#include "scene/scalar_map.h"

#include <algorithm>
#include <cmath>

namespace splotchcl {

double scaled(double value, Scaling scaling) {
  switch (scaling) {
    case Scaling::linear:
      return value;
    case Scaling::log:
      return std::log10(value);
    case Scaling::asinh:
      return std::asinh(value);
  }
  return value;
}

double unscaled(double value, Scaling scaling) {
  switch (scaling) {
    case Scaling::linear:
      return value;
    case Scaling::log:
      return std::pow(10, value);
    case Scaling::asinh:
      return std::sinh(value);
  }
  return value;
}

double normalized(double value, const ScalarMap& map) {
  const double v = scaled(value, map.scaling);
  if (!std::isfinite(v) || map.maximum == map.minimum) return 0;
  return std::clamp((v - map.minimum) / (map.maximum - map.minimum), 0.0, 1.0);
}

}  // namespace splotchcl
