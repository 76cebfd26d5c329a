// A grid interpolated to half its pixel size, axis by axis, by ten taps.

// Grids have even guards, so a finer pixel is left of its coarse pixel's center where its index is
// even. Every pixel that is looked at is in memory (picture_layout.h).

// The coarse pixel under the finer grid's pixel `index`.
inline int coarse_place(int index, Grid fine, Grid coarse) {
  return ((index - fine.guard) >> 1) + coarse.guard;
}

// The temporary has whole sixteens of the part's columns, from an even one on, and of the coarse
// grid's rows those that its rows are made from.
inline int first_column(const GridPart part) {
  return part.left & ~1;
}
inline size_t temporary_columns(const GridPart part) {
  return ((size_t)(part.right_end - first_column(part)) + 15) & ~(size_t)15;
}
inline int first_coarse_row(const GridPart part, Grid fine, Grid coarse) {
  return coarse_place(part.top, fine, coarse) - 5;
}
inline int coarse_rows(const GridPart part, Grid fine, Grid coarse) {
  return coarse_place(part.bottom - 1, fine, coarse) + 6 - first_coarse_row(part, fine, coarse);
}

// Work-item (eight coarse pixels, y of the temporary, plane): sixteen pixels of a row,
// interpolated along x.
__kernel void refine_columns(const RefineParameters p, __global const Grid* grids,
                             __global const float* planes, __global float* temporary) {
  const Grid coarse = grids[p.coarse], fine = grids[p.fine];
  const int x = first_column(p.part) + (int)get_global_id(0) * 2 * 8, y = (int)get_global_id(1);
  const uint c = (uint)get_global_id(2);
  const int rows = coarse_rows(p.part, fine, coarse);
  if (x >= p.part.right_end || y >= rows) return;
  __global const float* row = planes + pixel_at(coarse, c, coarse_place(x, fine, coarse),
                                                first_coarse_row(p.part, fine, coarse) + y);
  float8 even = (float8)(0.0f), odd = (float8)(0.0f);
  for (int k = 0; k < 10; ++k) {
    even += p.weights[k] * vload8(0, row - (k - 4));
    odd += p.weights[k] * vload8(0, row + (k - 4));
  }
  __global float* target =
      temporary + ((size_t)c * rows + y) * temporary_columns(p.part) + (x - first_column(p.part));
  vstore8((float8)(even.s0, odd.s0, even.s1, odd.s1, even.s2, odd.s2, even.s3, odd.s3), 0, target);
  vstore8((float8)(even.s4, odd.s4, even.s5, odd.s5, even.s6, odd.s6, even.s7, odd.s7), 1, target);
}

// Work-item (eight pixels, y, plane) of the part: interpolated along y and added to
// what the finer grid holds, if it does hold something.
__kernel void refine_rows(const RefineParameters p, __global const Grid* grids,
                          __global float* planes, __global const float* temporary) {
  const Grid coarse = grids[p.coarse], fine = grids[p.fine];
  const int x = p.part.left + (int)get_global_id(0) * 8, y = p.part.top + (int)get_global_id(1);
  const uint c = (uint)get_global_id(2);
  if (x >= p.part.right_end || y >= p.part.bottom) return;
  const int side = (y & 1) ? 1 : -1;
  const int row = coarse_place(y, fine, coarse) - first_coarse_row(p.part, fine, coarse);
  const size_t stride = temporary_columns(p.part);
  __global const float* column = temporary +
                                 ((size_t)c * coarse_rows(p.part, fine, coarse) + row) * stride +
                                 (x - first_column(p.part));
  __global float* target = planes + pixel_at(fine, c, x, y);
  float8 sum = p.add ? vload8(0, target) : (float8)(0.0f);
  for (int k = 0; k < 10; ++k) {
    sum += p.weights[k] * vload8(0, column + (k - 4) * side * (int)stride);
  }
  store_first(sum, p.part.right_end - x, target);
}
