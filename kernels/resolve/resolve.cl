// The sums of all grids, or the layers, to the light that they are. A work-item takes
// EIGHTS_OF_ITEM times eight pixels of a row.
#define LANES_8
#include "kernels/common/common.cl"
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#include "kernels/common/lanes.cl"
#if EXTENDED_NUMBERS
#include "kernels/common/double_lanes.cl"
#endif
#include "kernels/composite/opacity.cl"
#include "kernels/composite/shape.cl"
#include "kernels/resolve/resolve.h"

// The light behind everything: a colour, or a picture with one plane per channel, in rows
// that are padded to whole eights.
INLINED float8 light_behind(const ResolveParameters p, __global const float* background, int c,
                            int x, int y) {
  if (!BACKGROUND_IMAGE) return p.background[c];
  return vload8(0, background + ((size_t)c * p.height + y) * p.background_stride + x);
}

// What a channel shows: its own light, and this part of what is behind.
typedef struct ChannelLight {
  float8 own, transmittance;
} ChannelLight;

// Of sums. Coarse grids ring by a part of the tolerance: a sum may be slightly negative. No
// particle's weight or color is.
INLINED ChannelLight light_of_sum(float8 sum, float source) {
  const float8 summed = max(sum, (float8)(0.0f));
  ChannelLight light;
  if (LIGHT_EMISSION) {
    light.own = summed;
    light.transmittance = (float8)(1.0f);
    return light;
  }
  const float8 phi = phi_full(summed), opacity = summed * phi;
  // What is behind may be so bright that it shows through an opacity close to 1.
  light.transmittance = choose(1.0f - opacity, passed_in_full(summed, phi), summed > 0.5f);
  light.own = source * opacity;
  return light;
}

#if EXTENDED_NUMBERS
INLINED ChannelLight light_of_double_sum(double8 sum, float source) {
  const double8 passed = exp_of_minus(min(sum, (double8)(700.0)));
  const double8 opacity = select(1.0 - passed, sum * phi_of_thin(sum), sum < THIN_LAYER);
  ChannelLight light;
  light.transmittance = convert_float8(passed);
  light.own = source * convert_float8(opacity);
  return light;
}
#endif

// Of extended numbers of floats' precision the first part serves, but of sums that are depths.
INLINED ChannelLight light_of_channel(__global const float* pixels, size_t plane, size_t c,
                                      float source) {
  __global const float* own = pixels + PLANES_OF_NUMBER * c * plane;
  const float8 sum = vload8(0, own);
#if EXTENDED_NUMBERS
  if (!(LIGHT_ORDERED || LIGHT_EMISSION))
    return light_of_double_sum(sum_of_parts(sum, vload8(0, own + plane)), source);
#endif
  if (!LIGHT_ORDERED) return light_of_sum(sum, source);
  ChannelLight light;
  light.own = sum;
  light.transmittance = transmittance_of(vload8(0, own + 3 * PLANES_OF_NUMBER * plane));
  return light;
}

// Eight pixels of a row, from x on.
INLINED void resolve_eight(const ResolveParameters p, const Grid grid, __global const float* planes,
                           __global const float* background, __global float* image, int x, int y) {
  __global const float* pixels = planes + pixel_at(grid, 0, p.crop_x + x, p.crop_y + y);
  float light[4][8];
  float8 transmitted = (float8)(0.0f);
#pragma unroll
  for (int c = 0; c < 3; ++c) {
    const ChannelLight of =
        light_of_channel(pixels, (size_t)grid.plane_size, (size_t)c, p.source[c]);
    vstore8(of.own + of.transmittance * light_behind(p, background, c, x, y), 0, light[c]);
    transmitted += of.transmittance;
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
                                __global const float* planes, __global const float* background,
                                __global float* image, int number, int y) {
  const ResolveParameters p = *of_frame;
  const Grid grid = grids[0];
  const int left = number * PIXELS_OF_ITEM, right_end = min(left + PIXELS_OF_ITEM, p.width);
  for (int x = left; x < right_end; x += 8)
    resolve_eight(p, grid, planes, background, image, x, y);
}

// Work-item (pixels, y): linear red, green, blue and alpha.
__kernel void resolve(const ResolveParameters p, __global const Grid* grids,
                      __global const float* planes, __global const float* background,
                      __global float* image) {
  resolve_pixels(&p, grids, planes, background, image, (int)get_global_id(0),
                 (int)get_global_id(1));
}
