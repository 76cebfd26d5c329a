// Light of one part of a sum's splats added to that of another.
#define LANES_8
#include "kernels/common/lanes.cl"
#include "kernels/composite/composite.h"
#include "kernels/composite/planes.cl"

// Work-item (eight pixels, number), of the first plane's words. Rows of eight may reach beyond what
// is added, into padding.
__kernel void add_light(const MemoryRange p, __global float* to, __global const float* from) {
  const size_t i = get_global_id(0) * 8, plane = p.words;
  if (i >= plane) return;
  const size_t first = (size_t)p.first_low | ((size_t)p.first_high << 32);
  const size_t place = first + get_global_id(1) * PLANES_OF_NUMBER * plane + i;
  for (size_t k = place; k < place + 8; k += LANES)
    store_number(load_number(to + k, plane) + load_number(from + k, plane), to + k, plane);
}
