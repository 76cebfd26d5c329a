// Formulas that several stages share. The host puts a block of #defines and the headers of
// the stage in front of this file (src/device/stages/specialization.cpp).

#pragma OPENCL FP_CONTRACT ON

// Where a call would cost: PoCL leaves functions of some length as calls, and their structures
// in memory.
#ifndef INLINED  // scripts/test_icd has another for a simulator
#define INLINED __attribute__((always_inline)) inline
#endif

#ifdef ELLIPSES
#define SIGMA_X(splat) ((splat).along_x.sigma)
#define RADIUS_X(splat) ((splat).along_x.radius)
#else
#define SIGMA_X(splat) ((splat).sigma)
#define RADIUS_X(splat) ((splat).radius)
#endif

inline size_t first_float(const Grid grid) {
  return (size_t)grid.first_float_low | ((size_t)grid.first_float_high << 32);
}

// The grid that a tile belongs to. Grids are few, coarse ones small.
inline uint grid_of_tile(__global const Grid* grids, uint grid_count, uint tile) {
  uint g = 0;
  while (g + 1 < grid_count && tile >= grids[g + 1].first_tile)
    ++g;
  return g;
}

// First and last pixel whose centre (index + 1/2) lies within `radius` of `centre`,
// clamped to [0, size - 1]; first > last where there is none. Clamped before the
// conversion: a splat close to the camera may lie anywhere.
inline int2 pixel_range(float center, float radius, int size) {
  const float low = center - radius - 0.5f, high = center + radius - 0.5f;
  const float end = (float)size;
  const float first = low > 0.0f ? (low < end ? low : end) : 0.0f;
  const float last = high < end - 1.0f ? (high > -1.0f ? high : -1.0f) : end - 1.0f;
  // Up and down by comparison: ceil and floor are calls on PoCL.
  const int2 truncated = (int2)((int)first, (int)last);
  return (int2)(truncated.x + ((float)truncated.x < first),
                truncated.y - ((float)truncated.y > last));
}

// The radius of a cut disc: the drawn one, less the half pixel of pixel means.
inline float cut_radius(float radius) {
#ifdef SAMPLING_MEAN
  return radius - 0.5f;
#else
  return radius;
#endif
}
