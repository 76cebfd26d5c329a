// A grid whose splats were drawn narrower than they are is blurred once to their width
// (blur_filter.h): along x into a temporary, along y into the target. Guards are so wide
// that pixels too near to the grid's edge for all weights are never looked at.

// Rows of the temporary are longer than the grid's: the last eight of a row may pass its end.
inline size_t temporary_stride(const Grid grid) {
  return (size_t)grid.stride + 8;
}

// Work-item (eight pixels from half_width on, y, plane).
__kernel void blur_columns(const BlurParameters p, __global const Grid* grids,
                           __global const float* planes, __global float* temporary) {
  const Grid grid = grids[p.source];
  const int x = (int)get_global_id(0) * 8 + p.half_width;
  const int y = (int)get_global_id(1), c = (int)get_global_id(2);
  if (x >= grid.width - p.half_width) return;
  __global const float* row = planes + first_float(grid) + (size_t)c * grid.plane_size +
                              (size_t)y * grid.stride + (x - p.half_width);
  float8 sum = (float8)(0.0f);
  for (int k = 0; k <= 2 * p.half_width; ++k)
    sum += p.weights[k] * vload8(0, row + k);
  vstore8(sum, 0, temporary + ((size_t)c * grid.height + y) * temporary_stride(grid) + x);
}

// Work-item (eight pixels, y from half_width on, plane).
__kernel void blur_rows(const BlurParameters p, __global const Grid* grids, __global float* planes,
                        __global const float* temporary) {
  const Grid grid = grids[p.source], target = grids[p.target];
  const int x = (int)get_global_id(0) * 8;
  const int y = (int)get_global_id(1) + p.half_width, c = (int)get_global_id(2);
  if (x >= grid.width || y >= grid.height - p.half_width) return;
  const size_t stride = temporary_stride(grid);
  __global const float* column =
      temporary + ((size_t)c * grid.height + (y - p.half_width)) * stride + x;
  __global float* pixels =
      planes + first_float(target) + (size_t)c * target.plane_size + (size_t)y * target.stride + x;
  float8 sum = p.add ? vload8(0, pixels) : (float8)(0.0f);
  for (int k = 0; k <= 2 * p.half_width; ++k)
    sum += p.weights[k] * vload8(0, column + k * stride);
  vstore8(sum, 0, pixels);
}
