// A grid whose splats were drawn narrower than they are is blurred once to their width
// (blur_filter.h): along x into a temporary, along y into the target. Of all grids those parts are
// in memory that are looked at (picture_layout.h).

// Rows of the temporary are whole eights, and begin with the part's first pixel.
static inline size_t temporary_stride(const GridPart part) {
  return ((size_t)(part.right_end - part.left) + 7) & ~(size_t)7;
}

// Work-item (eight pixels, y from half_width above the part on, plane).
__kernel void blur_columns(const BlurParameters p, __global const Grid* grids,
                           __global const float* planes, __global float* temporary) {
  const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1);
  const uint c = (uint)get_global_id(2);
  const int rows = p.part.bottom - p.part.top + 2 * p.half_width;
  if (p.part.left + x >= p.part.right_end || y >= rows) return;
  __global const float* row = planes + pixel_at(grids[p.source], c, p.part.left + x - p.half_width,
                                                p.part.top + y - p.half_width);
  float8 sum = (float8)(0.0f);
  for (int k = 0; k <= 2 * p.half_width; ++k)
    sum += p.weights[k] * vload8(0, row + k);
  vstore8(sum, 0, temporary + ((size_t)c * rows + y) * temporary_stride(p.part) + x);
}

// Work-item (eight pixels, y, plane) of the part.
__kernel void blur_rows(const BlurParameters p, __global const Grid* grids, __global float* planes,
                        __global const float* temporary) {
  const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1);
  const uint c = (uint)get_global_id(2);
  const int rows = p.part.bottom - p.part.top + 2 * p.half_width;
  const int count = p.part.right_end - p.part.left - x;
  if (count <= 0 || p.part.top + y >= p.part.bottom) return;
  const size_t stride = temporary_stride(p.part);
  __global const float* column = temporary + ((size_t)c * rows + y) * stride + x;
  __global float* pixels = planes + pixel_at(grids[p.target], c, p.part.left + x, p.part.top + y);
  float8 sum = p.add ? vload8(0, pixels) : (float8)(0.0f);
  for (int k = 0; k <= 2 * p.half_width; ++k)
    sum += p.weights[k] * vload8(0, column + k * stride);
  store_first(sum, count, pixels);
}
