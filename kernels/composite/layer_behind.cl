// A pixel of a layer, all its planes, behind what is in front of it; for GPUs.
#include "kernels/common/lanes.cl"
#include "kernels/composite/opacity.cl"

static inline void add_layer(float* front, const float* layer) {
#if LIGHT_ORDERED
  for (int c = 0; c < 3; ++c) {
    const float transmittance = transmittance_of(front[c + 3]);
    front[c] += transmittance * layer[c];
    front[c + 3] = carry_behind(front[c + 3], transmittance, layer[c + 3]);
  }
#else
  for (int c = 0; c < PLANES; ++c)
    front[c] += layer[c];
#endif
}
