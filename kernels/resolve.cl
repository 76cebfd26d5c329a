// The sums of all grids, brought to the picture's pixels, and the light that they are.

// Interpolation to half the pixel size, cell-centred: Lagrange weights of the eight
// nearest coarse pixels -3 .. 4 for a point a quarter of a pixel right of pixel 0; mirrored
// for one to the left. On a Gaussian of width sigma coarse pixels the error is at most
// 1.29 / sigma^8 of its peak per axis (docs/accuracy.md).
__constant float refine_weights[8] = {
    -0.001888275146484375f, 0.019092559814453125f, -0.10309982299804688f, 0.8591651916503906f,
    0.2863883972167969f,    -0.07364273071289062f, 0.015621185302734375f, -0.001636505126953125f};

// The coarse pixel under pixel `index` of the next finer grid, and on which side of its
// centre that lies: +1 right, -1 left.
inline int2 coarse_place(int index, int fine_guard, int coarse_guard) {
  const int from_corner = index - fine_guard;
  return (int2)((from_corner >> 1) + coarse_guard, (from_corner & 1) ? 1 : -1);
}

// Work-item (x of the finer grid, y of the coarser one, plane).
__kernel void refine_columns(uint coarse_index, __global const Grid* grids,
                             __global const float* planes, __global float* temporary) {
  const Grid coarse = grids[coarse_index], fine = grids[coarse_index - 1];
  const int x = (int)get_global_id(0), y = (int)get_global_id(1), c = (int)get_global_id(2);
  if (x >= fine.width || y >= coarse.height) return;
  const int2 place = coarse_place(x, fine.guard, coarse.guard);
  __global const float* row = planes + first_float(coarse) + (size_t)c * coarse.plane_size +
                              (size_t)y * coarse.stride;
  float sum = 0.0f;
  for (int k = 0; k < 8; ++k) {
    sum += refine_weights[k] * row[clamp(place.x + (k - 3) * place.y, 0, coarse.width - 1)];
  }
  temporary[((size_t)c * coarse.height + y) * fine.stride + x] = sum;
}

// Work-item (x, y of the finer grid, plane).
__kernel void refine_rows(uint coarse_index, __global const Grid* grids, __global float* planes,
                          __global const float* temporary) {
  const Grid coarse = grids[coarse_index], fine = grids[coarse_index - 1];
  const int x = (int)get_global_id(0), y = (int)get_global_id(1), c = (int)get_global_id(2);
  if (x >= fine.width || y >= fine.height) return;
  const int2 place = coarse_place(y, fine.guard, coarse.guard);
  float sum = 0.0f;
  for (int k = 0; k < 8; ++k) {
    const int row = clamp(place.x + (k - 3) * place.y, 0, coarse.height - 1);
    sum += refine_weights[k] * temporary[((size_t)c * coarse.height + row) * fine.stride + x];
  }
  planes[first_float(fine) + (size_t)c * fine.plane_size + (size_t)y * fine.stride + x] += sum;
}

// Linear red, green, blue and alpha of every pixel.
__kernel void resolve(const ResolveParameters p, __global const Grid* grids,
                      __global const float* planes, __global float* image) {
  const int x = (int)get_global_id(0), y = (int)get_global_id(1);
  if (x >= p.width || y >= p.height) return;
  const Grid grid = grids[0];
  __global const float* pixel = planes + first_float(grid) + (size_t)y * grid.stride + x;
  float light[3], transmittance[3];
  for (int c = 0; c < 3; ++c) {
    const float sum = pixel[(size_t)c * grid.plane_size];
#if defined(LIGHT_ORDERED)
    transmittance[c] = 1.0f - pixel[(size_t)(c + 3) * grid.plane_size];
    light[c] = sum + transmittance[c] * p.background[c];
#elif defined(LIGHT_EMISSION)
    transmittance[c] = 1.0f;
    light[c] = sum + p.background[c];
#else
    // Coarse grids ring by a part of the tolerance: a sum may be slightly negative.
    const float opacity = -expm1(-max(sum, 0.0f));
    transmittance[c] = 1.0f - opacity;
    light[c] = p.source[c] * opacity + transmittance[c] * p.background[c];
#endif
  }
  const float alpha = 1.0f - (transmittance[0] + transmittance[1] + transmittance[2]) / 3.0f;
  vstore4((float4)(light[0], light[1], light[2], alpha), (size_t)y * p.width + x, image);
}
