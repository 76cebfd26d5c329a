#include "device/stages/field_scaling.h"

#include <cmath>
#include <optional>

#include "device/frame/shared.h"
#include "scene/scalar_map.h"

namespace splotchcl {
namespace {

// Of an absent field, whose values are read as 1.
KernelScaling always(double place) {
  return {SCALING_LINEAR, 0, 0, place};
}

}  // namespace

KernelScaling kernel_scaling(const ScalarMap& map) {
  const double range = map.maximum - map.minimum;
  const double inverse_range = range > 0 ? 1 / range : 0;
  const bool is_log = map.scaling == Scaling::log;
  if (const std::optional<double> least = least_before_scaling(map)) {
    if (is_log) return {SCALING_LOG_FROM_LEAST, *least, 1 / *least, inverse_range / std::log(10)};
    return {SCALING_ASINH_FROM_LEAST, *least, std::hypot(1, *least), inverse_range};
  }
  const int scaling = is_log                          ? SCALING_LOG
                      : map.scaling == Scaling::asinh ? SCALING_ASINH
                                                      : SCALING_LINEAR;
  return {scaling, map.minimum, 0, inverse_range};
}

KernelScaling color_scaling(const DrawnComponent& component) {
  return component.particles.color.is_absent() ? always(0) : kernel_scaling(component.color);
}

KernelScaling intensity_scaling(const DrawnComponent& component) {
  return component.particles.intensity.is_absent() ? always(1)
                                                   : kernel_scaling(component.intensity);
}

}  // namespace splotchcl
