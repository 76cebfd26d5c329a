// A pixel of a layer behind the planes' one.
static inline void join_pixel(__global float* planes, size_t plane, __global const float* partial,
                              size_t pixel) {
#ifdef LIGHT_ORDERED
  for (int c = 0; c < 3; ++c) {
    __global float* source = planes + (size_t)c * plane;
    __global float* opacity = planes + (size_t)(c + 3) * plane;
    const float transmittance = transmittance_of(*opacity);
    const float behind = partial[(size_t)(c + 3) * TILE_WIDTH * TILE_HEIGHT + pixel];
    *source += transmittance * partial[(size_t)c * TILE_WIDTH * TILE_HEIGHT + pixel];
    *opacity = carry_behind(*opacity, transmittance, behind);
  }
#else
  for (int c = 0; c < PLANES; ++c) {
    planes[(size_t)c * plane] += partial[(size_t)c * TILE_WIDTH * TILE_HEIGHT + pixel];
  }
#endif
}
