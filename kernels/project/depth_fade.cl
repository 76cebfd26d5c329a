// Light that fades with depth (camera.h, DepthFade).
#include "kernels/common/common.cl"
#include "kernels/common/lanes.cl"
#include "kernels/project/project.h"

#pragma OPENCL FP_CONTRACT OFF

INLINED int has_fade(const ProjectParameters p) {
  return p.inverse_near_fade > 0.0f || p.inverse_far_fade > 0.0f;
}

// Smoothly from 0 to 1.
INLINED VALUE rising(VALUE part) {
  const VALUE u = clamp(part, (VALUE)(0.0f), (VALUE)(1.0f));
  return u * u * (3.0f - 2.0f * u);
}
// The part of their light that particles at these depths keep.
INLINED VALUE part_after_fade(VALUE depth, const ProjectParameters p) {
  VALUE part = (VALUE)(1.0f);
  if (p.inverse_near_fade > 0.0f) part = rising((depth - p.fade_begin) * p.inverse_near_fade);
  if (p.inverse_far_fade > 0.0f) part *= rising((p.fade_end - depth) * p.inverse_far_fade);
  return part;
}
