// The device's own 2^t, of whose error the language says nothing, at places that the host chooses
// (src/device/opencl/device_context.h).
#include "kernels/common/group_sums.cl"

__kernel OF_GROUPS void try_native_exp2(__global const float* t, __global float* values) {
  const uint i = get_global_id(0);
  values[i] = native_exp2(t[i]);
}
