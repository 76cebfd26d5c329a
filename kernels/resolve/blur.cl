// A grid whose splats were drawn narrower than they are is blurred once to their width
// (grid_filters.h): along x into a temporary, along y into the target. Of all grids those parts are
// in memory that are looked at (picture_layout.h).
#include "kernels/common/common.cl"
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#include "kernels/resolve/resolve.h"

// Rows of the temporary are whole eights, and begin with the part's first pixel.
static inline size_t temporary_stride(const GridPart part) {
  return ((size_t)(part.right_end - part.left) + 7) & ~(size_t)7;
}

// What eight pixels from `center` on take of those beside them, `stride` floats apart: two of one
// weight at a time.
INLINED float8 blurred(__global const float* center, size_t stride, const float* weights,
                       int half_width) {
  float8 sum = weights[half_width] * vload8(0, center), behind = (float8)(0.0f);
  for (int k = 1; k <= half_width; ++k) {
    const float weight = weights[half_width + k];
    sum += weight * vload8(0, center - k * stride);
    behind += weight * vload8(0, center + k * stride);
  }
  return sum + behind;
}

// Work-item (eight pixels, y from half_width above the part on, plane).
__kernel void blur_columns(const BlurParameters p, __global const Grid* grids,
                           __global const float* planes, __global float* temporary) {
  const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1);
  const uint c = (uint)get_global_id(2);
  const int rows = p.part.bottom - p.part.top + 2 * p.half_width;
  if (p.part.left + x >= p.part.right_end || y >= rows) return;
  // The part is the target's, which has no guard band where it is the picture's own grid.
  const Grid source = grids[p.source];
  const int shift = source.guard - grids[p.target].guard;
  __global const float* pixels =
      planes + pixel_at(source, c, p.part.left + x + shift, p.part.top + y - p.half_width + shift);
  vstore8(blurred(pixels, 1, p.weights, p.half_width), 0,
          temporary + ((size_t)c * rows + y) * temporary_stride(p.part) + x);
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
  __global const float* pixel = temporary + ((size_t)c * rows + y + p.half_width) * stride + x;
  __global float* pixels = planes + pixel_at(grids[p.target], c, p.part.left + x, p.part.top + y);
  const float8 sum = blurred(pixel, stride, p.weights, p.half_width);
  store_first(p.add ? vload8(0, pixels) + sum : sum, count, pixels);
}
