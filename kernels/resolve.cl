// The sums of all grids, brought to the picture's pixels, and the light that they are.

// Weights of the ten nearest coarse pixels -4 .. 5 for a point a quarter of a pixel right of
// pixel 0; mirrored for one to the left (refinement_filter.h).
__constant float refine_weights[10] = REFINE_WEIGHTS;

// Grids have even guards of at least ten pixels, so every pixel below is inside, and a
// finer pixel is left of its coarse pixel's centre where its index is even.

// The coarse pixel under the finer grid's pixel `index`.
inline int coarse_place(int index, Grid fine, Grid coarse) {
  return (index - fine.guard) / 2 + coarse.guard - (index < fine.guard && (index & 1) ? 1 : 0);
}

// Work-item (eight coarse pixels, y of the coarser grid, plane): sixteen pixels of a row,
// interpolated along x.
__kernel void refine_columns(uint coarse_index, uint fine_index, __global const Grid* grids,
                             __global const float* planes, __global float* temporary) {
  const Grid coarse = grids[coarse_index], fine = grids[fine_index];
  const int x = (int)get_global_id(0) * 2 * 8;
  const int y = (int)get_global_id(1), c = (int)get_global_id(2);
  if (x >= fine.width) return;
  __global const float* row = planes + first_float(coarse) + (size_t)c * coarse.plane_size +
                              (size_t)y * coarse.stride + coarse_place(x, fine, coarse);
  float8 even = (float8)(0.0f), odd = (float8)(0.0f);
  for (int k = 0; k < 10; ++k) {
    even += refine_weights[k] * vload8(0, row - (k - 4));
    odd += refine_weights[k] * vload8(0, row + (k - 4));
  }
  __global float* target = temporary + ((size_t)c * coarse.height + y) * fine.stride + x;
  vstore8((float8)(even.s0, odd.s0, even.s1, odd.s1, even.s2, odd.s2, even.s3, odd.s3), 0, target);
  vstore8((float8)(even.s4, odd.s4, even.s5, odd.s5, even.s6, odd.s6, even.s7, odd.s7), 1, target);
}

// Work-item (eight pixels, y of the finer grid, plane): interpolated along y and added to
// what the finer grid holds, if it does hold something.
__kernel void refine_rows(uint coarse_index, uint fine_index, int add,
                          __global const Grid* grids, __global float* planes,
                          __global const float* temporary) {
  const Grid coarse = grids[coarse_index], fine = grids[fine_index];
  const int x = (int)get_global_id(0) * 8;
  const int y = (int)get_global_id(1), c = (int)get_global_id(2);
  if (x >= fine.width) return;
  const int side = (y & 1) ? 1 : -1;
  __global const float* column =
      temporary + ((size_t)c * coarse.height + coarse_place(y, fine, coarse)) * fine.stride + x;
  __global float* target =
      planes + first_float(fine) + (size_t)c * fine.plane_size + (size_t)y * fine.stride + x;
  float8 sum = add ? vload8(0, target) : (float8)(0.0f);
  for (int k = 0; k < 10; ++k) {
    sum += refine_weights[k] * vload8(0, column + (k - 4) * side * (int)fine.stride);
  }
  vstore8(sum, 0, target);
}

// The light behind everything: a colour, or a picture with one plane per channel, in rows
// that are padded to whole eights.
#ifdef BACKGROUND_IMAGE
#define BACKGROUND_ARGUMENT __global const float* background,
#define BACKGROUND(c, x, y) \
  vload8(0, background + ((size_t)(c) * p.height + (y)) * p.background_stride + (x))
#else
#define BACKGROUND_ARGUMENT
#define BACKGROUND(c, x, y) p.background[c]
#endif

// Work-item (eight pixels, y): linear red, green, blue and alpha.
__kernel void resolve(const ResolveParameters p, __global const Grid* grids,
                      __global const float* planes, BACKGROUND_ARGUMENT __global float* image) {
  const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1);
  if (x >= p.width) return;
  const Grid grid = grids[0];
  __global const float* pixels = planes + first_float(grid) + (size_t)y * grid.stride + x;
  float light[4][8];
  float8 transmitted = (float8)(0.0f);
  for (int c = 0; c < 3; ++c) {
#ifdef EXACT_NUMBERS
    // The two parts of a sum (composite_exact.cl); in the ordered plan three more of depths.
    __global const float* parts = pixels + (size_t)(2 * c) * grid.plane_size;
    const float8 sum = vload8(0, parts), low = vload8(0, parts + grid.plane_size);
#else
    const float8 sum = vload8(0, pixels + (size_t)c * grid.plane_size);
#endif
#if defined(EXACT_NUMBERS) && defined(LIGHT_ORDERED)
    const float8 depth = vload8(0, parts + (size_t)6 * grid.plane_size);
    const float8 transmittance =
        precise_exp_negative(depth, vload8(0, parts + (size_t)7 * grid.plane_size));
    const float8 own = sum;
#elif defined(EXACT_NUMBERS) && !defined(LIGHT_EMISSION)
    const float8 opacity = sum * precise_phi(sum);
    const float8 transmittance = precise_exp_negative(sum, low);
    const float8 own = p.source[c] * opacity;
#elif defined(LIGHT_ORDERED)
    const float8 transmittance =
        transmittance_of(vload8(0, pixels + (size_t)(c + 3) * grid.plane_size));
    const float8 own = sum;
#elif defined(LIGHT_EMISSION)
    const float8 transmittance = (float8)(1.0f);
    const float8 own = sum;
#else
    // Coarse grids ring by a part of the tolerance: a sum may be slightly negative.
    const float8 depth = max(sum, (float8)(0.0f));
    const float8 phi = phi_full(depth), opacity = depth * phi;
    // What is behind may be so bright that it shows through an opacity close to 1.
    const float8 transmittance = choose(1.0f - opacity, passed_in_full(depth, phi), depth > 0.5f);
    const float8 own = p.source[c] * opacity;
#endif
    vstore8(own + transmittance * BACKGROUND(c, x, y), 0, light[c]);
    transmitted += transmittance;
  }
  vstore8(1.0f - transmitted / 3.0f, 0, light[3]);
  const int count = min(8, p.width - x);
  __global float* out = image + ((size_t)y * p.width + x) * 4;
  for (int i = 0; i < count; ++i) {
#ifdef PROJECTION_FISHEYE
    // Half pixels from the middle: outside the circle there is no direction to show.
    const long across = 2 * (x + i) + 1 + p.circle_x, along = 2 * y + 1 + p.circle_y;
    if (across * across + along * along > (long)p.circle_diameter * p.circle_diameter) {
      vstore4((float4)(0.0f), i, out);
      continue;
    }
#endif
    vstore4((float4)(light[0][i], light[1][i], light[2][i], light[3][i]), i, out);
  }
}
