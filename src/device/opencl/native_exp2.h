#pragma once

#include "device/opencl/device_context.h"

namespace splotchcl {

// The largest error of the device's own 2^t, relative to 2^t, among 65537 places from -126 to 0,
// half of them above -1; infinite where it is no number, or not tiny below -126. The language
// promises nothing of it.
double error_of_native_exp2(DeviceContext& device);

// Whether it is as exact as the polynomial in whose place it is taken (gaussian.cl).
bool native_exp2_serves(DeviceContext& device);

}  // namespace splotchcl
