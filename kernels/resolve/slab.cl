// Slabs of an ordered frame: the wide splats of a slab, which coarse grids hold as sums of optical
// depth and light, are laid among its narrow ones, which the picture's own planes hold in order.
#define LANES_8
#include "kernels/common/common.cl"
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#include "kernels/composite/shape.cl"
#include "kernels/resolve/refine.cl"
#include "kernels/resolve/resolve.h"

// phi(T) = (1 - exp(-T)) / T of what takes the part `opacity` = 1 - exp(-T) away, and T.
INLINED float8 depth_of(float8 opacity) {
  const float8 x = min(opacity, 0.999999f);
  const float8 series = x * (1.0f + x * (0.5f + x * (1.0f / 3.0f + x * (0.25f + x * 0.2f))));
  const int8 deep = x > 0.1f;
  return any(deep) ? select(series, -log(1.0f - x), deep) : series;
}

// Most slabs are thin everywhere.
INLINED float8 phi_of_depth(float8 depth) {
  return any(depth >= 0.1f) ? phi_full(depth) : phi_series(depth);
}

// Lays depth and light of one channel among what eight pixels hold, and returns the most that any
// order of the slab's splats could change of them.
INLINED float8 lay_channel(float8 depth, float8 light, int count, __global float* source,
                           __global float* opacity, __global float* source_before,
                           __global float* opacity_before) {
  // Coarse grids ring by a part of the tolerance.
  depth = max(depth, (float8)(0.0f));
  const float8 source0 = vload8(0, source_before), opacity0 = vload8(0, opacity_before);
  const float8 opacity1 = vload8(0, opacity), passed0 = 1.0f - opacity0;
  const float8 taken = min(opacity1 - opacity0, passed0) / max(passed0, 1e-30f);
  const float8 narrow_depth = depth_of(taken);
  // Of less than a rounding it is 1; quotients of the smallest tails are anything.
  const float8 narrow_phi = select((float8)(1.0f), taken / narrow_depth, taken > 0x1p-24f);
  const float8 phi = phi_of_depth(depth);
  const float8 narrow = vload8(0, source) - source0, wide = passed0 * light;
  const float8 new_source = source0 + narrow * phi + wide * (phi * narrow_phi);
  const float8 new_opacity = opacity1 + (1.0f - opacity1) * (depth * phi);
  store_first(new_source, count, source);
  store_first(new_opacity, count, opacity);
  store_first(new_source, count, source_before);
  store_first(new_opacity, count, opacity_before);
  return 0.5f * (fabs(narrow) * depth + fabs(wide) * (narrow_depth + depth));
}

static inline float largest_of_first(float8 values, int count) {
  float lanes[8];
  vstore8(values, 0, lanes);
  float largest = 0.0f;
  for (int k = 0; k < 8; ++k)
    largest = k < count ? max(largest, lanes[k]) : largest;
  return largest;
}

// Planes of a row lie all over memory, more of them than a processor sees coming: what items two
// lines of the cache further on need that rows above have not fetched.
#define PIXELS_AHEAD 32
static inline void ask_for_pixels(__global float* planes, __global const float* columns,
                                  __global float* before, const RefineParameters p,
                                  const Grid coarse, const Grid fine, int x, int first) {
  const size_t last_row = REFINEMENT_REACH * temporary_columns(p.part) + PIXELS_AHEAD;
  for (uint c = 0; c < 6; ++c) {
    ask_for(column_of(columns, p.part, fine, coarse, c, x, first) + last_row);
    for (int y = max(first, p.part.top); y < min(first + 2, p.part.bottom); ++y) {
      const size_t place = pixel_at(fine, c, x + PIXELS_AHEAD, y);
      ask_to_write(planes + place);
      ask_to_write(before + (place - first_float(fine)));
    }
  }
}

// Eight pixels of two rows, from x on.
INLINED void lay_eight(const RefineParameters p, const Grid coarse, const Grid fine,
                       __global float* planes, __global const float* columns,
                       __global float* before, __global float* errors, int x, int first) {
  const int count = p.part.right_end - x;
  const size_t stride = temporary_columns(p.part);
  ask_for_pixels(planes, columns, before, p, coarse, fine, x, first);
  float8 largest[2] = {(float8)(0.0f), (float8)(0.0f)};
  for (uint c = 0; c < 3; ++c) {
    const Pair depth =
        between(column_of(columns, p.part, fine, coarse, c, x, first), stride, p.weights);
    const Pair light =
        between(column_of(columns, p.part, fine, coarse, c + 3, x, first), stride, p.weights);
    for (int r = 0; r < 2; ++r) {
      const int y = first + r;
      if (y < p.part.top || y >= p.part.bottom) continue;
      const size_t source = pixel_at(fine, c, x, y), opacity = pixel_at(fine, c + 3, x, y);
      const size_t grid = first_float(fine);
      const float8 changed = lay_channel(
          r == 0 ? depth.even : depth.odd, r == 0 ? light.even : light.odd, count, planes + source,
          planes + opacity, before + (source - grid), before + (opacity - grid));
      largest[r] = max(largest[r], changed);
    }
  }
  const size_t strips = (size_t)(p.part.right_end - p.part.left + 7) / 8;
  for (int r = 0; r < 2; ++r) {
    const int y = first + r;
    if (y < p.part.top || y >= p.part.bottom) continue;
    const size_t strip = (size_t)(y - p.part.top) * strips + (size_t)((x - p.part.left) / 8);
    errors[strip] += largest_of_first(largest[r], count);
  }
}

// Item `number` of a pair of rows.
KERNEL_BODY void lay_pixels(const RefineParameters* refined, __global const Grid* grids,
                            __global float* planes, __global const float* columns,
                            __global float* before, __global float* errors, int number, int pair) {
  const RefineParameters p = *refined;
  const Grid coarse = grids[p.coarse], fine = grids[p.fine];
  const int first = first_of_pair(p.part, pair);
  if (first >= p.part.bottom) return;
  const int left = p.part.left + number * PIXELS_OF_ITEM;
  const int right_end = min(left + PIXELS_OF_ITEM, p.part.right_end);
  for (int x = left; x < right_end; x += 8)
    lay_eight(p, coarse, fine, planes, columns, before, errors, x, first);
}

// Work-item (pixels, pair of rows) of the part: sums interpolated along y from `columns`
// (refine_columns), then laid. `before` has the planes as they were before the slab, and takes what
// they are after it; `errors` the most that any order of the slab's splats could change of eight
// pixels (docs/dev/accuracy.md, "Slabs").
__kernel void lay_slab(const RefineParameters p, __global const Grid* grids, __global float* planes,
                       __global const float* columns, __global float* before,
                       __global float* errors) {
  lay_pixels(&p, grids, planes, columns, before, errors, (int)get_global_id(0),
             (int)get_global_id(1));
}
