// Light of one part of a sum's splats added to that of another.
#include "kernels/composite/composite.h"

static inline size_t first_of(const AddLightParameters p) {
  return (size_t)p.first_low | ((size_t)p.first_high << 32);
}

// Work-item (eight floats, plane). Rows of eight may reach beyond what is added, into padding.
__kernel void add_light(const AddLightParameters p, __global float* to,
                        __global const float* from) {
  const size_t i = get_global_id(0) * 8;
  if (i >= p.plane_floats) return;
  const size_t place = first_of(p) + get_global_id(1) * (size_t)p.plane_floats + i;
  vstore8(vload8(0, to + place) + vload8(0, from + place), 0, to + place);
}

// The same of numbers that are sums of two floats, each part in a plane of its own. Work-item
// (eight floats, pair of planes).
__kernel void add_pairs_of_light(const AddLightParameters p, __global float* to,
                                 __global const float* from) {
#pragma OPENCL FP_CONTRACT OFF
  const size_t i = get_global_id(0) * 8;
  if (i >= p.plane_floats) return;
  const size_t high = first_of(p) + get_global_id(1) * (size_t)2 * p.plane_floats + i;
  const size_t low = high + p.plane_floats;
  const float8 a = vload8(0, to + high), b = vload8(0, from + high);
  const float8 sum = a + b, part = sum - a;
  const float8 rest = (a - (sum - part)) + (b - part) + vload8(0, to + low) + vload8(0, from + low);
  const float8 rounded = sum + rest;
  vstore8(rounded, 0, to + high);
  vstore8(rest - (rounded - sum), 0, to + low);
}
