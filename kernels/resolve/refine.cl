// A grid interpolated to half its pixel size, axis by axis. A work-item takes EIGHTS_OF_ITEM times
// eight pixels of a row.
#include "kernels/common/common.cl"
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#include "kernels/resolve/resolve.h"

// Grids have even guards, so a finer pixel is left of its coarse pixel's center where its index is
// even. Every pixel that is looked at is in memory (picture_layout.h).

// The coarse pixel under the finer grid's pixel `index`.
static inline int coarse_place(int index, Grid fine, Grid coarse) {
  return ((index - fine.guard) >> 1) + coarse.guard;
}

// The temporary has whole sixteens of the part's columns, from an even one on, and of the coarse
// grid's rows those that its rows are made from.
static inline int first_column(const GridPart part) {
  return part.left & ~1;
}
static inline size_t temporary_columns(const GridPart part) {
  return ((size_t)(part.right_end - first_column(part)) + 15) & ~(size_t)15;
}
static inline int first_coarse_row(const GridPart part, Grid fine, Grid coarse) {
  return coarse_place(part.top, fine, coarse) - REFINEMENT_REACH;
}
static inline int coarse_rows(const GridPart part, Grid fine, Grid coarse) {
  const int last = coarse_place(part.bottom - 1, fine, coarse) + REFINEMENT_REACH;
  return last + 1 - first_coarse_row(part, fine, coarse);
}

// Two neighboring pixels of one axis, of which the first is even, lie on one coarse pixel and share
// those around it. Eight of both.
typedef struct Pair {
  float8 even, odd;
} Pair;

// From where `center` has the coarse ones, those beside them along the axis `stride` floats apart.
INLINED Pair between(__global const float* center, size_t stride, const float* weights) {
  Pair pair = {(float8)(0.0f), (float8)(0.0f)};
#pragma unroll
  for (int k = -REFINEMENT_REACH; k <= REFINEMENT_REACH; ++k) {
    const float8 beside = vload8(0, center + k * (int)stride);
    if (k < REFINEMENT_REACH) pair.even += weights[REFINEMENT_REACH - 1 - k] * beside;
    if (k > -REFINEMENT_REACH) pair.odd += weights[REFINEMENT_REACH - 1 + k] * beside;
  }
  return pair;
}

// Stores sixteen pixels of a row.
INLINED void store_pair(const Pair sums, __global float* target) {
  const float8 even = sums.even, odd = sums.odd;
  vstore8((float8)(even.s0, odd.s0, even.s1, odd.s1, even.s2, odd.s2, even.s3, odd.s3), 0, target);
  vstore8((float8)(even.s4, odd.s4, even.s5, odd.s5, even.s6, odd.s6, even.s7, odd.s7), 1, target);
}

// Item `number` of row y of the temporary.
KERNEL_BODY void refine_along_x(const RefineParameters* refined, __global const Grid* grids,
                                __global const float* planes, __global float* temporary, int number,
                                int y, uint c) {
  const RefineParameters p = *refined;
  const Grid coarse = grids[p.coarse], fine = grids[p.fine];
  const int rows = coarse_rows(p.part, fine, coarse);
  if (y >= rows) return;
  const int left = number * 2 * PIXELS_OF_ITEM, x = first_column(p.part) + left;
  __global const float* row = planes + pixel_at(coarse, c, coarse_place(x, fine, coarse),
                                                first_coarse_row(p.part, fine, coarse) + y);
  __global float* target = temporary + ((size_t)c * rows + y) * temporary_columns(p.part) + left;
  const int count = min(PIXELS_OF_ITEM, (p.part.right_end - x + 1) / 2);
  for (int k = 0; k < count; k += 8)
    store_pair(between(row + k, 1, p.weights), target + 2 * k);
}

// Work-item (coarse pixels, y of the temporary, plane): twice as many pixels of a row,
// interpolated along x.
__kernel void refine_columns(const RefineParameters p, __global const Grid* grids,
                             __global const float* planes, __global float* temporary) {
  refine_along_x(&p, grids, planes, temporary, (int)get_global_id(0), (int)get_global_id(1),
                 (uint)get_global_id(2));
}

// The first row of the pair that a work-item takes: the part may begin or end within a pair.
static inline int first_of_pair(const GridPart part, int pair) {
  return (part.top & ~1) + 2 * pair;
}

// Where the temporary has eight pixels of plane c on the coarse row of row y.
static inline __global const float* column_of(__global const float* temporary, const GridPart part,
                                              const Grid fine, const Grid coarse, uint c, int x,
                                              int y) {
  const int row = coarse_place(y, fine, coarse) - first_coarse_row(part, fine, coarse);
  return temporary + ((size_t)c * coarse_rows(part, fine, coarse) + row) * temporary_columns(part) +
         (x - first_column(part));
}

// Item `number` of a pair of rows.
KERNEL_BODY void refine_along_y(const RefineParameters* refined, __global const Grid* grids,
                                __global float* planes, __global const float* temporary, int number,
                                int pair, uint c) {
  const RefineParameters p = *refined;
  const Grid coarse = grids[p.coarse], fine = grids[p.fine];
  const int first = first_of_pair(p.part, pair);
  if (first >= p.part.bottom) return;
  const size_t stride = temporary_columns(p.part);
  const int left = p.part.left + number * PIXELS_OF_ITEM;
  const int right_end = min(left + PIXELS_OF_ITEM, p.part.right_end);
  for (int x = left; x < right_end; x += 8) {
    __global const float* column = column_of(temporary, p.part, fine, coarse, c, x, first);
    ask_for(column + (REFINEMENT_REACH + 1) * stride);
    __global float* below = planes + pixel_at(fine, c, x, first + 2);
    ask_to_write(below);
    ask_to_write(below + fine.stride);
    const Pair sums = between(column, stride, p.weights);
    for (int y = max(first, p.part.top); y < min(first + 2, p.part.bottom); ++y) {
      __global float* target = planes + pixel_at(fine, c, x, y);
      const float8 sum = y == first ? sums.even : sums.odd;
      store_first(p.add ? vload8(0, target) + sum : sum, p.part.right_end - x, target);
    }
  }
}

// Work-item (pixels, pair of rows, plane) of the part: interpolated along y and added to
// what the finer grid holds, if it does hold something.
__kernel void refine_rows(const RefineParameters p, __global const Grid* grids,
                          __global float* planes, __global const float* temporary) {
  refine_along_y(&p, grids, planes, temporary, (int)get_global_id(0), (int)get_global_id(1),
                 (uint)get_global_id(2));
}
