// The sums of all grids, or the layers, to the light that they are. A work-item takes
// EIGHTS_OF_ITEM times eight pixels of a row.
#define LANES_8
#include "kernels/common/common.cl"
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#include "kernels/common/lanes.cl"
#include "kernels/composite/opacity.cl"
#include "kernels/composite/shape.cl"
#include "kernels/extended/precise.cl"
#include "kernels/resolve/resolve.h"

// The light behind everything: a colour, or a picture with one plane per channel, in rows
// that are padded to whole eights.
#if BACKGROUND_IMAGE
#define BACKGROUND_PARAMETER __global const float *background,
#define BACKGROUND_ARGUMENT background,
#define BACKGROUND(c, x, y) \
  vload8(0, background + ((size_t)(c)*p.height + (y)) * p.background_stride + (x))
#else
#define BACKGROUND_PARAMETER
#define BACKGROUND_ARGUMENT
#define BACKGROUND(c, x, y) p.background[c]
#endif

// Eight pixels of a row, from x on.
INLINED void resolve_eight(const ResolveParameters p, const Grid grid, __global const float* planes,
                           BACKGROUND_PARAMETER __global float* image, int x, int y) {
  __global const float* pixels = planes + pixel_at(grid, 0, p.crop_x + x, p.crop_y + y);
  float light[4][8];
  float8 transmitted = (float8)(0.0f);
#pragma unroll
  for (int c = 0; c < 3; ++c) {
#if EXTENDED_NUMBERS
    // The two parts of a sum (extended_pixels.cl); in the ordered plan three more of depths.
    __global const float* parts = pixels + (size_t)(2 * c) * grid.plane_size;
    const float8 sum = vload8(0, parts), low = vload8(0, parts + grid.plane_size);
#else
    const float8 sum = vload8(0, pixels + (size_t)c * grid.plane_size);
#endif
#if EXTENDED_NUMBERS && LIGHT_ORDERED
    const float8 depth = vload8(0, parts + (size_t)6 * grid.plane_size);
    const float8 transmittance =
        precise_exp_negative(depth, vload8(0, parts + (size_t)7 * grid.plane_size));
    const float8 own = sum;
#elif EXTENDED_NUMBERS && !LIGHT_EMISSION
    const float8 opacity = sum * precise_phi(sum);
    const float8 transmittance = precise_exp_negative(sum, low);
    const float8 own = p.source[c] * opacity;
#elif LIGHT_ORDERED
    const float8 transmittance =
        transmittance_of(vload8(0, pixels + (size_t)(c + 3) * grid.plane_size));
    const float8 own = sum;
#elif LIGHT_EMISSION
    const float8 transmittance = (float8)(1.0f);
    // Coarse grids ring by a part of the tolerance: a sum may be slightly negative. No particle's
    // weight or color is.
    const float8 own = max(sum, (float8)(0.0f));
#else
    // As above.
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
  const int count = p.width - x;
  __global float* out = image + ((size_t)y * p.width + x) * 4;
  // As many steps every time: lanes are registers then, not memory.
  for (int i = 0; i < 8; ++i) {
    if (i >= count) continue;
    // Half pixels from the middle: outside the circle there is no direction to show.
    const long across = 2 * (x + i) + 1 + p.circle_x, along = 2 * y + 1 + p.circle_y;
    if (p.circle_diameter > 0 &&
        across * across + along * along > (long)p.circle_diameter * p.circle_diameter) {
      vstore4((float4)(0.0f), i, out);
      continue;
    }
    vstore4((float4)(light[0][i], light[1][i], light[2][i], light[3][i]), i, out);
  }
}

// Item `number` of row y.
KERNEL_BODY void resolve_pixels(const ResolveParameters* of_frame, __global const Grid* grids,
                                __global const float* planes,
                                BACKGROUND_PARAMETER __global float* image, int number, int y) {
  const ResolveParameters p = *of_frame;
  const Grid grid = grids[0];
  const int left = number * PIXELS_OF_ITEM, right_end = min(left + PIXELS_OF_ITEM, p.width);
  for (int x = left; x < right_end; x += 8)
    resolve_eight(p, grid, planes, BACKGROUND_ARGUMENT image, x, y);
}

// Work-item (pixels, y): linear red, green, blue and alpha.
__kernel void resolve(const ResolveParameters p, __global const Grid* grids,
                      __global const float* planes, BACKGROUND_PARAMETER __global float* image) {
  resolve_pixels(&p, grids, planes, BACKGROUND_ARGUMENT image, (int)get_global_id(0),
                 (int)get_global_id(1));
}
