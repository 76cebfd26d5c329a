// Which pixels a splat of a tile is drawn in, along an axis.
#include "kernels/common/common.cl"

#pragma OPENCL FP_CONTRACT ON

// First and last pixel whose center (index + first_center) lies within `radius` of `center`,
// clamped to [0, size - 1]; first > last where there is none. Clamped before the
// conversion: a splat close to the camera may lie anywhere.
INLINED int2 pixel_range(float center, float radius, float first_center, int size) {
  const float low = center - radius - first_center, high = center + radius - first_center;
  const float end = (float)size;
  const float first = low > 0.0f ? (low < end ? low : end) : 0.0f;
  const float last = high < end - 1.0f ? (high > -1.0f ? high : -1.0f) : end - 1.0f;
  // Up and down by comparison: ceil and floor are calls on PoCL.
  const int2 truncated = (int2)((int)first, (int)last);
  return (int2)(truncated.x + ((float)truncated.x < first),
                truncated.y - ((float)truncated.y > last));
}

// The radius of a cut disc: the drawn one, less the half pixel of pixel means.
static inline float cut_radius(float radius) {
#if SAMPLING_MEAN
  return radius - 0.5f;
#else
  return radius;
#endif
}
