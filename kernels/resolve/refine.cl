// A grid interpolated to half its pixel size, axis by axis, by ten taps.

// Grids have even guards of at least ten pixels, so every pixel below is inside, and a
// finer pixel is left of its coarse pixel's centre where its index is even.

// The coarse pixel under the finer grid's pixel `index`.
inline int coarse_place(int index, Grid fine, Grid coarse) {
  return (index - fine.guard) / 2 + coarse.guard - (index < fine.guard && (index & 1) ? 1 : 0);
}

// Work-item (eight coarse pixels, y of the coarser grid, plane): sixteen pixels of a row,
// interpolated along x.
__kernel void refine_columns(const RefineParameters p, __global const Grid* grids,
                             __global const float* planes, __global float* temporary) {
  const Grid coarse = grids[p.coarse], fine = grids[p.fine];
  const int x = (int)get_global_id(0) * 2 * 8;
  const int y = (int)get_global_id(1), c = (int)get_global_id(2);
  if (x >= fine.width) return;
  __global const float* row = planes + first_float(coarse) + (size_t)c * coarse.plane_size +
                              (size_t)y * coarse.stride + coarse_place(x, fine, coarse);
  float8 even = (float8)(0.0f), odd = (float8)(0.0f);
  for (int k = 0; k < 10; ++k) {
    even += p.weights[k] * vload8(0, row - (k - 4));
    odd += p.weights[k] * vload8(0, row + (k - 4));
  }
  __global float* target = temporary + ((size_t)c * coarse.height + y) * fine.stride + x;
  vstore8((float8)(even.s0, odd.s0, even.s1, odd.s1, even.s2, odd.s2, even.s3, odd.s3), 0, target);
  vstore8((float8)(even.s4, odd.s4, even.s5, odd.s5, even.s6, odd.s6, even.s7, odd.s7), 1, target);
}

// Work-item (eight pixels, y of the finer grid, plane): interpolated along y and added to
// what the finer grid holds, if it does hold something.
__kernel void refine_rows(const RefineParameters p, __global const Grid* grids,
                          __global float* planes, __global const float* temporary) {
  const Grid coarse = grids[p.coarse], fine = grids[p.fine];
  const int x = (int)get_global_id(0) * 8;
  const int y = (int)get_global_id(1), c = (int)get_global_id(2);
  if (x >= fine.width) return;
  const int side = (y & 1) ? 1 : -1;
  __global const float* column =
      temporary + ((size_t)c * coarse.height + coarse_place(y, fine, coarse)) * fine.stride + x;
  __global float* target =
      planes + first_float(fine) + (size_t)c * fine.plane_size + (size_t)y * fine.stride + x;
  float8 sum = p.add ? vload8(0, target) : (float8)(0.0f);
  for (int k = 0; k < 10; ++k) {
    sum += p.weights[k] * vload8(0, column + (k - 4) * side * (int)fine.stride);
  }
  vstore8(sum, 0, target);
}
