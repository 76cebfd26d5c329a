// Slabs of an ordered frame: the wide splats of a slab, which coarse grids hold as sums of optical
// depth and light, are laid among its narrow ones, which the picture's own planes hold in order.

// phi(T) = (1 - exp(-T)) / T of what takes the part `opacity` = 1 - exp(-T) away, and T.
INLINED float8 depth_of(float8 opacity) {
  const float8 x = min(opacity, 0.999999f);
  const float8 series = x * (1.0f + x * (0.5f + x * (1.0f / 3.0f + x * (0.25f + x * 0.2f))));
  const int8 deep = x > 0.1f;
  return any(deep) ? select(series, -log(1.0f - x), deep) : series;
}

// Work-item (eight pixels, y) of the part: sums interpolated along y from `columns`
// (refine_columns), then laid. `before` has the planes as they were before the slab, and takes what
// they are after it; `errors` the most that any order of the slab's splats could change of eight
// pixels (docs/accuracy.md, "Slabs").
__kernel void lay_slab(const RefineParameters p, __global const Grid* grids, __global float* planes,
                       __global const float* columns, __global float* before,
                       __global float* errors) {
  const Grid coarse = grids[p.coarse], fine = grids[p.fine];
  const int x = p.part.left + (int)get_global_id(0) * 8, y = p.part.top + (int)get_global_id(1);
  if (x >= p.part.right_end || y >= p.part.bottom) return;
  const int side = (y & 1) ? 1 : -1;
  const int rows = coarse_rows(p.part, fine, coarse);
  const int row = coarse_place(y, fine, coarse) - first_coarse_row(p.part, fine, coarse);
  const size_t stride = temporary_columns(p.part);
  const int count = p.part.right_end - x;
  float8 largest = (float8)(0.0f);
  for (uint c = 0; c < 3; ++c) {
    __global const float* depths =
        columns + ((size_t)c * rows + row) * stride + (x - first_column(p.part));
    __global const float* lights = depths + (size_t)3 * rows * stride;
    float8 depth = (float8)(0.0f), light = (float8)(0.0f);
    for (int k = 0; k < 10; ++k) {
      depth += p.weights[k] * vload8(0, depths + (k - 4) * side * (int)stride);
      light += p.weights[k] * vload8(0, lights + (k - 4) * side * (int)stride);
    }
    // Coarse grids ring by a part of the tolerance.
    depth = max(depth, (float8)(0.0f));
    const size_t at_source = pixel_at(fine, c, x, y), at_opacity = pixel_at(fine, c + 3, x, y);
    const size_t first = first_float(fine);
    const float8 source = vload8(0, planes + at_source), opacity = vload8(0, planes + at_opacity);
    const float8 source0 = vload8(0, before + (at_source - first));
    const float8 opacity0 = vload8(0, before + (at_opacity - first));
    const float8 passed0 = 1.0f - opacity0;
    const float8 taken = min(opacity - opacity0, passed0) / max(passed0, 1e-30f);
    const float8 narrow_depth = depth_of(taken);
    const float8 narrow_phi =
        select((float8)(1.0f), taken / max(narrow_depth, 1e-30f), taken > 0.0f);
    const float8 phi = phi_full(depth);
    const float8 narrow = source - source0, wide = passed0 * light;
    const float8 new_source = source0 + narrow * phi + wide * (phi * narrow_phi);
    const float8 new_opacity = opacity + (1.0f - opacity) * (depth * phi);
    store_first(new_source, count, planes + at_source);
    store_first(new_opacity, count, planes + at_opacity);
    store_first(new_source, count, before + (at_source - first));
    store_first(new_opacity, count, before + (at_opacity - first));
    largest = max(largest, fabs(narrow) * depth + fabs(wide) * (narrow_depth + depth));
  }
  for (int k = count; k < 8; ++k)
    ((float*)&largest)[k] = 0.0f;
  const float4 four = max(largest.lo, largest.hi);
  const float2 two = max(four.lo, four.hi);
  const size_t strips = (size_t)(p.part.right_end - p.part.left + 7) / 8;
  errors[(size_t)get_global_id(1) * strips + get_global_id(0)] += 0.5f * max(two.x, two.y);
}
