#pragma once

#include "splotchcl/frame.h"

namespace splotchcl {

// How kernels bring a field to [0, 1] (kernels/project/project.h, FieldScaling), before it is
// rounded to what they hold.
struct KernelScaling {
  int scaling = 0;  // SCALING_...
  double minimum = 0, factor = 0, inverse_range = 0;
};
KernelScaling kernel_scaling(const ScalarMap& map);

// A color field that is absent is palette position 0, whatever the map says; an intensity 1.
KernelScaling color_scaling(const DrawnComponent& component);
KernelScaling intensity_scaling(const DrawnComponent& component);

}  // namespace splotchcl
