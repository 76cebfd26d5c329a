// Compositing of extended precision on any device: a work-group
// takes a segment of one tile's list, a work-item eight pixels of a row. For a batch of
// splats at a time the group works out the shapes' columns and rows in extended numbers, and then
// every pixel takes their products. Sums are extended numbers; in the ordered plan the optical
// depth is summed instead of the opacity, so that no transmittance loses its digits, however thick
// what lies before.
#define LANES_8
#include "kernels/bin/bin.h"
#include "kernels/common/common.cl"
#include "kernels/common/ellipse.h"
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#include "kernels/composite/composite.h"
#include "kernels/composite/extended_pixels.cl"
#include "kernels/extended/extended.cl"
#include "kernels/extended/extended_lanes.cl"
#include "kernels/extended/extended_splat.h"
#include "kernels/extended/precise.cl"

#pragma OPENCL FP_CONTRACT OFF

#define AXES (TILE_WIDTH + TILE_HEIGHT)
#define BATCH 8
#if KERNEL_CUT && !FACE_OF_CUBE
#define CUT_BY_AXES
#endif

// The mean of exp(-t^2 / sigma^2) over a pixel whose centre is at distance d, by the
// differences of erfc that do not cancel.
static inline Extended narrow_mean(Extended d, Extended sigma) {
  const Extended far = extended_sum(d, extended_of(0.5f)),
                 near = extended_difference(d, extended_of(0.5f));
  const Extended far_erfc = extended_erfc(extended_quotient(far, sigma));
  const Extended near_erfc = extended_erfc(extended_quotient(extended_magnitude(near), sigma));
  const Extended difference =
      is_negative(near) ? extended_difference(extended_of(2.0f), extended_sum(near_erfc, far_erfc))
                        : extended_difference(near_erfc, far_erfc);
  const Extended half_root_pi = extended_constant(8.862269521e-01f, -2.662319964e-08f);
  return extended_product(extended_product(half_root_pi, sigma), difference);
}

// The mean of exp(bend t^2) cosh(slope t) over -1/2 < t < 1/2, less 1, for bend >= -1/9: by
// its series in the derivatives of a Gaussian up to the sixth, the next being below
// slope^8 / 9e7, or by six points of Gauss, which err by 2e-16 slope^12.
static inline float mean_excess(float slope, float bend) {
  if (slope < 1.0f) {
    const float s = slope * slope;
    const float second = s + 2.0f * bend;
    const float fourth = (s + 12.0f * bend) * s + 12.0f * bend * bend;
    const float sixth =
        ((s + 30.0f * bend) * s + 180.0f * bend * bend) * s + 120.0f * bend * bend * bend;
    return second * (1.0f / 24.0f) + fourth * (1.0f / 1920.0f) + sixth * (1.0f / 322560.0f);
  }
  const float points[3] = {0.466234757f, 0.330604693f, 0.119309593f};
  const float weights[3] = {0.0856622462f, 0.180380787f, 0.233956967f};
  float excess = 0.0f;
  for (int k = 0; k < 3; ++k) {
    const float t = points[k], even = bend * t * t;
    excess += weights[k] * (expm1(even + slope * t) + expm1(even - slope * t));
  }
  return excess;
}

// The mean over a pixel for sigma >= 3: exp(-d^2 / sigma^2) times the mean of
// exp(-2 d t / sigma^2 - t^2 / sigma^2), which is close to 1.
static inline Extended wide_mean(Extended d, Extended sigma) {
  const Extended u = extended_quotient(d, sigma);
  const float inverse = 1.0f / high_part(sigma);
  const float excess = mean_excess(2.0f * high_part(u) * inverse, -inverse * inverse);
  const Extended center = extended_exp(extended_negative(extended_product(u, u)));
  return extended_product(center, extended_sum(extended_of(1.0f), extended_of(excess)));
}

// One axis of the shape in the pixel whose centre is at distance d >= 0.
static inline Extended extended_axis(Extended d, Extended sigma) {
#if SAMPLING_MEAN
  if (high_part(sigma) < 3.0f) return narrow_mean(d, sigma);
  if (high_part(sigma) < 1e4f) return wide_mean(d, sigma);
#endif
  const Extended u = extended_quotient(d, sigma);
  return extended_exp(extended_negative(extended_product(u, u)));
}

// A column of the splat, behind what is already there.
static inline void add_column(Pixels* pixels, ExtendedLanes column,
                              const __local ExtendedSplat* splat) {
  for (int c = 0; c < 3; ++c) {
#if LIGHT_ORDERED
    const ExtendedLanes depth = lanes_product(column, extended_pair(splat->summed[c]));
    const float8 emitted = high_lanes(column) * splat->emission[c].high;
    const float8 seen = transmittance(pixels->depth[c]) * precise_phi(high_lanes(depth));
    pixels->light[c] = lanes_sum(pixels->light[c], lanes_pair(emitted * seen, (float8)(0.0f)));
    pixels->depth[c] = lanes_sum(pixels->depth[c], depth);
#else
    const ExtendedLanes light = lanes_product(column, extended_pair(splat->summed[c]));
    pixels->light[c] = lanes_sum(pixels->light[c], light);
#endif
  }
}

// What the group works out of a batch of splats: of each the shape's columns, then its rows.
typedef struct Batch {
  ExtendedSplat splats[BATCH];
  float high[BATCH * AXES], low[BATCH * AXES];
#ifdef CUT_BY_AXES
  float square_high[BATCH * AXES], square_low[BATCH * AXES];  // of the distance
  int holds[BATCH * AXES];                                    // the splat's centre
#endif
} Batch;

// `place` of the tile's columns and rows, whose pixel centre lies at `centre`.
static inline void fill_axis(__local Batch* batch, uint k, uint place, float center) {
  const __local ExtendedSplat* splat = batch->splats + k;
  const int is_column = place < TILE_WIDTH;
  const FloatPair splat_center = is_column ? splat->x : splat->y;
  const FloatPair sigma = is_column ? SIGMA_X(*splat) : splat->sigma;
  const float radius = is_column ? RADIUS_X(*splat) : splat->radius;
  const Extended d = extended_difference(extended_of(center), extended_pair(splat_center));
  Extended value = extended_of(0.0f);
  if (fabs(high_part(d)) <= radius) {
    value = extended_axis(extended_magnitude(d), extended_pair(sigma));
  }
  batch->high[k * AXES + place] = high_part(value);
  batch->low[k * AXES + place] = low_part(value);
#ifdef CUT_BY_AXES
  Extended offset = d;
#if ELLIPSES
  // As far from the center as in the disc that the ellipse is made of.
  if (is_column) {
    offset =
        extended_quotient(extended_product(d, extended_pair(splat->sigma)), extended_pair(sigma));
  }
#endif
  const Extended square = extended_product(offset, offset);
  batch->square_high[k * AXES + place] = high_part(square);
  batch->square_low[k * AXES + place] = low_part(square);
  // The pixel that holds the centre: a pixel begins at its own edge.
  batch->holds[k * AXES + place] =
      extended_less(extended_of(-0.5f), d) && !extended_less(extended_of(0.5f), d);
#endif
}

#ifdef CUT_BY_AXES
// The columns of eight pixels, without those outside the cut disc.
static inline ExtendedLanes cut_column(ExtendedLanes column, const __local Batch* batch, uint k,
                                       uint x, uint y) {
  const Extended cut = extended_pair(batch->splats[k].cut);
  const Extended cut_square = extended_product(cut, cut);
  FloatPair row;
  row.high = batch->square_high[k * AXES + y];
  row.low = batch->square_low[k * AXES + y];
  int inside[8];
  for (int lane = 0; lane < 8; ++lane) {
    FloatPair square;
    square.high = batch->square_high[k * AXES + x + lane];
    square.low = batch->square_low[k * AXES + x + lane];
    inside[lane] =
        !extended_less(cut_square, extended_sum(extended_pair(square), extended_pair(row)));
#if SAMPLING_MEAN
    inside[lane] |= batch->holds[k * AXES + x + lane] && batch->holds[k * AXES + y];
#endif
  }
  const int8 mask = vload8(0, inside) != 0;
  return lanes_pair(select((float8)(0.0f), high_lanes(column), mask),
                    select((float8)(0.0f), low_lanes(column), mask));
}
#endif

#if FACE_OF_CUBE
static inline Extended extended_square(Extended a) {
  return extended_product(a, a);
}

// face_shape() of face_shape.cl, in the pixel whose corner is (x, y).
static inline Extended extended_face_shape(const __local ExtendedSplat* splat, float x, float y,
                                           const CubeFace face) {
  const Extended column = extended_of(x + 0.5f), row = extended_of(y + 0.5f);
  const Extended dx = extended_difference(column, extended_pair(splat->x));
  const Extended dy = extended_difference(row, extended_pair(splat->y));
  if (fabs(high_part(dx)) > RADIUS_X(*splat) || fabs(high_part(dy)) > splat->radius)
    return extended_of(0.0f);
  const Extended tangent = extended_pair(face.inverse_focal);
  const Extended tangent_x =
      extended_product(extended_difference(column, extended_pair(face.middle_x)), tangent);
  const Extended tangent_y =
      extended_product(extended_difference(row, extended_pair(face.middle_y)), tangent);
  const Extended k = extended_sum(
      extended_of(1.0f), extended_sum(extended_square(tangent_x), extended_square(tangent_y)));
  const Extended gk = extended_product(extended_pair(splat->tilt.squared_width), k);
  const Extended m = extended_sum(gk, extended_pair(splat->tilt.footprint));
  const Extended turned =
      extended_difference(extended_product(tangent_x, dy), extended_product(tangent_y, dx));
  const Extended squared =
      extended_sum(extended_sum(extended_square(dx), extended_square(dy)), extended_square(turned));
  const Extended exponent =
      extended_quotient(extended_product(squared, extended_pair(splat->tilt.inverse_secant2)), m);
#if KERNEL_CUT
  if (extended_less(extended_square(extended_pair(splat->cut)), exponent)) return extended_of(0.0f);
#endif
  return extended_product(extended_exp(extended_negative(exponent)), extended_quotient(gk, m));
}

// Of eight pixels of a row.
static inline ExtendedLanes column_on_face(const __local ExtendedSplat* splat, float x, float y,
                                           const CubeFace face) {
  float high[8], low[8];
  for (int lane = 0; lane < 8; ++lane) {
    const Extended value = extended_face_shape(splat, x + (float)lane, y, face);
    high[lane] = high_part(value);
    low[lane] = low_part(value);
  }
  return lanes_pair(vload8(0, high), vload8(0, low));
}
#endif

__kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void composite(
    const CompositeParameters p, __global const Grid* grids, __global const Segment* segments,
    __global const TileSplat* entries, __global float* planes, __global float* partials,
    __global const ExtendedSplat* extended_splats, __global const CloudEntry* clouds,
    __global const CloudSplat* cloud_splats, __global const float* directions,
    __global const DirectionCone* cones, __global const Stencil* stencils) {
  __local Batch batch;
  const uint item = get_local_id(0);
  const Segment segment = segments[p.first_segment + get_group_id(0)];
  const Grid grid = grids[grid_of_tile(grids, p.grid_count, segment.tile)];
  const uint in_grid = segment.tile - grid.first_tile;
  const uint first_x = (uint)grid.first_x, first_y = (uint)grid.first_y;
  const float corner_x = (float)(first_x + in_grid % (uint)grid.tiles_x * TILE_WIDTH);
  const float corner_y = (float)(first_y + in_grid / (uint)grid.tiles_x * TILE_HEIGHT);
  __global float* own = own_planes(planes, grid, segment.tile, item);
  Pixels pixels = segment.partial == NO_PARTIAL ? load_pixels(own, grid.plane_size) : no_pixels();
  for (uint first = segment.begin; first < segment.end; first += BATCH) {
    const uint count = min((uint)BATCH, segment.end - first);
    if (item < count) batch.splats[item] = extended_splats[entries[first + item].slot];
    barrier(CLK_LOCAL_MEM_FENCE);
#if !FACE_OF_CUBE
    for (uint place = item; place < count * AXES; place += GROUP) {
      const uint axis = place % AXES;
      const float center = axis < TILE_WIDTH ? corner_x + (float)axis + 0.5f
                                             : corner_y + (float)(axis - TILE_WIDTH) + 0.5f;
      fill_axis(&batch, place / AXES, axis, center);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
#endif
    const uint x = item * 8 % TILE_WIDTH, y = TILE_WIDTH + item * 8 / TILE_WIDTH;
    for (uint k = 0; k < count; ++k) {
#if FACE_OF_CUBE
      const ExtendedLanes column = column_on_face(batch.splats + k, corner_x + (float)x,
                                                  corner_y + (float)(y - TILE_WIDTH), p.face);
#else
      FloatPair along;
      along.high = batch.high[k * AXES + y];
      along.low = batch.low[k * AXES + y];
      const float8 across = vload8(0, batch.high + k * AXES + x);
      if (along.high == 0.0f || !any(across != 0.0f)) continue;
      ExtendedLanes column = lanes_product(lanes_pair(across, vload8(0, batch.low + k * AXES + x)),
                                           extended_pair(along));
#ifdef CUT_BY_AXES
      column = cut_column(column, &batch, k, x, y);
#endif
#endif
      add_column(&pixels, column, batch.splats + k);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  if (segment.partial == NO_PARTIAL) {
    store_pixels(pixels, own, grid.plane_size);
  } else {
    store_pixels(pixels, partials + (size_t)segment.partial * PLANES * TILE_PIXELS + item * 8,
                 TILE_PIXELS);
  }
}
