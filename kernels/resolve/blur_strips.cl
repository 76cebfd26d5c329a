// All grids of a level blurred to where they add up, by processors: blur.cl in strips of so many
// columns that the rows which a pixel takes stay in the nearest cache, in VALUEs (lanes.cl).
#define LANES_8
#include "kernels/common/common.cl"
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#include "kernels/common/lanes.cl"
#include "kernels/resolve/resolve.h"

#define VALUES_OF_STRIP (STRIP / LANES)
// Rows that were blurred along x, at their number modulo a power of two that holds all of a
// pixel's.
#define RING_ROWS MOST_BLUR_WEIGHTS
// Its rows are found by their last bits.
REQUIRE(ring_of_a_power_of_two, (RING_ROWS & (RING_ROWS - 1)) == 0);

// VALUEs at any address in one access: of sums of those that vload16 returns compilers make pieces
// of two floats.
#ifdef __clang__
typedef VALUE __attribute__((aligned(4))) AnyValue;
#define load_of_ring(p) (*(const AnyValue*)(p))
#define load_of_planes(p) (*(__global const AnyValue*)(p))
#else
#define load_of_ring LOAD
#define load_of_planes LOAD
#endif

typedef struct StripRow {
  VALUE values[VALUES_OF_STRIP];
} StripRow;

// A row has few lines of the cache, and the next one lies pages away: hardware sees none coming.
#define ROWS_AHEAD 8
INLINED void ask_for_row(__global const float* first, int half_width) {
  for (int x = -half_width; x < STRIP + half_width; x += NUMBERS_OF_LINE)
    ask_for(first + x);
}

// Of the strip's pixels, the first of which lies at `first`.
INLINED StripRow blurred_along_x(__global const float* first, const BlurWeights* blur) {
  StripRow sum;
#pragma unroll
  for (int v = 0; v < VALUES_OF_STRIP; ++v)
    sum.values[v] = blur->weights[0] * load_of_planes(first + v * LANES);
  for (int k = 1; k <= blur->half_width; ++k) {
    const float weight = blur->weights[k];
#pragma unroll
    for (int v = 0; v < VALUES_OF_STRIP; ++v) {
      __global const float* center = first + v * LANES;
      sum.values[v] += weight * (load_of_planes(center - k) + load_of_planes(center + k));
    }
  }
  return sum;
}

INLINED const float* ring_row(const float* ring, int y) {
  return ring + (y & (RING_ROWS - 1)) * STRIP;
}

INLINED StripRow blurred_along_y(const float* ring, int y, const BlurWeights* blur) {
  StripRow sum;
  const float* center = ring_row(ring, y);
#pragma unroll
  for (int v = 0; v < VALUES_OF_STRIP; ++v)
    sum.values[v] = blur->weights[0] * load_of_ring(center + v * LANES);
  for (int k = 1; k <= blur->half_width; ++k) {
    const float weight = blur->weights[k];
    const float *above = ring_row(ring, y - k), *below = ring_row(ring, y + k);
#pragma unroll
    for (int v = 0; v < VALUES_OF_STRIP; ++v)
      sum.values[v] += weight * (load_of_ring(above + v * LANES) + load_of_ring(below + v * LANES));
  }
  return sum;
}

INLINED void put_row(const StripRow row, int count, int add, __global float* pixels) {
  if (count >= STRIP) {
#pragma unroll
    for (int v = 0; v < VALUES_OF_STRIP; ++v) {
      __global float* to = pixels + v * LANES;
      const VALUE held = add ? load_of_planes(to) : (VALUE)(0.0f);
      STORE(held + row.values[v], to);
    }
    return;
  }
  float lanes[STRIP];
#pragma unroll
  for (int v = 0; v < VALUES_OF_STRIP; ++v)
    STORE(row.values[v], lanes + v * LANES);
  for (int x = 0; x < count; ++x)
    pixels[x] = (add ? pixels[x] : 0.0f) + lanes[x];
}

// Rows from `top` on to before `bottom` of the strip that begins at column `left`, in pixels of the
// target. A call whose last argument tells the compiler that it may use registers of sixteen floats
// (lanes.cl).
__attribute__((noinline)) static void blur_strip(const BlurWeights* blur, const Grid source_grid,
                                                 const Grid target_grid,
                                                 __global const float* sources,
                                                 __global float* targets, uint plane, int left,
                                                 int top, int bottom, int count, int add,
                                                 INTEGER lanes) {
  float ring[RING_ROWS * STRIP] __attribute__((aligned(64)));
  const int half_width = blur->half_width, shift = source_grid.guard - target_grid.guard;
  for (int y = top - half_width; y < bottom + half_width; ++y) {
    __global const float* first = sources + pixel_at(source_grid, plane, left + shift, y + shift);
    ask_for_row(first + ROWS_AHEAD * source_grid.stride, half_width);
    const StripRow row = blurred_along_x(first, blur);
    float* const to = ring + (y & (RING_ROWS - 1)) * STRIP;
#pragma unroll
    for (int v = 0; v < VALUES_OF_STRIP; ++v)
      STORE(row.values[v], to + v * LANES);
    const int finished = y - half_width;
    if (finished < top) continue;
    put_row(blurred_along_y(ring, finished, blur), count, add,
            targets + pixel_at(target_grid, plane, left, finished));
  }
}

// Work-item (strip, band of rows, plane) of the part.
__kernel void blur_strips(const BlurStripsParameters p, __global const Grid* grids,
                          __global const float* sources, __global float* targets) {
  const int left = p.part.left + (int)get_global_id(0) * STRIP;
  const int top = p.part.top + (int)get_global_id(1) * ROWS_OF_BAND;
  if (left >= p.part.right_end || top >= p.part.bottom) return;
  for (int i = 0; i < p.source_count; ++i) {
    const BlurWeights blur = p.blurs[i];
    blur_strip(&blur, grids[blur.source], grids[p.target], sources, targets, (uint)get_global_id(2),
               left, top, min(top + ROWS_OF_BAND, p.part.bottom), p.part.right_end - left,
               p.add || i > 0, NUMBERS_OF_LANES);
  }
}
