// Clouds around the camera, which are no splats: the host draws them.
#include "kernels/common/common.cl"
#include "kernels/common/lanes.cl"
#include "kernels/project/load.cl"
#include "kernels/project/project.h"
#include "kernels/project/view.cl"

#pragma OPENCL FP_CONTRACT OFF

// Good particles from so many sigma on are splats; `offset` is from the camera.
INLINED INTEGER are_around(VALUE h, const Vectors offset, const ProjectParameters p) {
  const VALUE reach = p.around_reach * h;
  return squared_distance(offset, p.length_scale) < reach * reach;
}
