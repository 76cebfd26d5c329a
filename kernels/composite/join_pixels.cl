// LANES pixels of a layer behind the planes' one.
#include "kernels/common/lanes.cl"
#include "kernels/composite/opacity.cl"

static inline void join_pixels(__global float* planes, size_t plane, __global const float* partial,
                               size_t pixel) {
#if LIGHT_ORDERED
  for (int c = 0; c < 3; ++c) {
    __global float* source = planes + (size_t)c * plane;
    __global float* opacity = planes + (size_t)(c + 3) * plane;
    const VALUE before = LOAD(opacity), transmittance = transmittance_of(before);
    const VALUE behind = LOAD(partial + (size_t)(c + 3) * TILE_WIDTH * TILE_HEIGHT + pixel);
    const VALUE light = LOAD(partial + (size_t)c * TILE_WIDTH * TILE_HEIGHT + pixel);
    STORE(LOAD(source) + transmittance * light, source);
    STORE(carry_behind(before, transmittance, behind), opacity);
  }
#else
  for (int c = 0; c < PLANES; ++c) {
    __global float* light = planes + (size_t)c * plane;
    STORE(LOAD(light) + LOAD(partial + (size_t)c * TILE_WIDTH * TILE_HEIGHT + pixel), light);
  }
#endif
}
