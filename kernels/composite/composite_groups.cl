// Compositing for GPUs: a work-group takes a segment of one tile's list, a work-item one pixel,
// batch by batch (tile_batch.cl). Formulas are those of composite_rows.cl, on single floats.
#include "kernels/bin/bin.h"
#include "kernels/common/common.cl"
#include "kernels/common/flags.cl"
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#include "kernels/common/lanes.cl"
#include "kernels/composite/clouds.cl"
#include "kernels/composite/composite.h"
#include "kernels/composite/face_shape.cl"
#include "kernels/composite/layer_behind.cl"
#include "kernels/composite/opacity.cl"
#include "kernels/composite/pixel_range.cl"
#include "kernels/composite/shape.cl"
#include "kernels/composite/stencil.cl"
#include "kernels/composite/tile_batch.cl"
#include "kernels/extended/extended_splat.h"

#if FACE_OF_CUBE
#define TILE_PARAMETER , const TileOnFace* on_face
#define TILE_ARGUMENT , &on_face
#define TILE_PASSED , on_face
#else
#define TILE_PARAMETER
#define TILE_ARGUMENT
#define TILE_PASSED
#endif

// Of an ellipse: a disc's pixels follow from two numbers (cut_of_axis()).
#if KERNEL_CUT && ELLIPSES && !FACE_OF_CUBE
static inline int is_inside_cut(const __local TileSplat* splat, uint x, uint y) {
  const float dx = (float)x + FIRST_X - splat->x - LOW_X(*splat);
  const float dy = (float)y + FIRST_Y - splat->y - LOW_Y(*splat);
  const float cut = cut_radius(splat->radius);
  const float round_dx = dx * (cut / cut_radius(splat->along_x.radius));
  int inside = round_dx * round_dx + dy * dy <= cut * cut;
#if SAMPLING_MEAN
  inside |= dx > -0.5f && dx <= 0.5f && dy > -0.5f && dy <= 0.5f;
#endif
  return inside;
}
#endif

#if LIGHT_ORDERED
// As THIN_CHANNEL and LAYER_CHANNEL of composite_rows.cl.
static inline void add_thin_channel(float* pixel, int c, float emission, float absorption,
                                    float shape, float half_square) {
  const float opacity = pixel[c + 3];
  const float covered = shape - half_square * absorption;
  const float u = covered - opacity * covered;
  pixel[c] += u * emission;
  pixel[c + 3] = opacity + u * absorption;
}

static inline void add_channel(float* pixel, int c, float emission, float absorption, float shape,
                               int by_series) {
  const float opacity = pixel[c + 3], depth = shape * absorption;
  const float phi = by_series ? phi_series(depth) : phi_full(depth);
  const float passed = by_series ? passed_by_series(depth, phi) : passed_in_full(depth, phi);
  const float t = transmittance_of(opacity);
  const float u = t * (shape * phi);
  pixel[c] += u * emission;
  pixel[c + 3] = carry(opacity, u * absorption, t * passed);
}

INLINED void add_thin_splat(float* pixel, const __local BatchLight* light, uint k, float shape) {
  const float4 layer = light->absorption_and_red[k];
  const float2 emission = light->green_and_blue[k];
  const float half_square = 0.5f * (shape * shape);
  add_thin_channel(pixel, 0, layer.w, layer.x, shape, half_square);
  add_thin_channel(pixel, 1, emission.x, layer.y, shape, half_square);
  add_thin_channel(pixel, 2, emission.y, layer.z, shape, half_square);
}

INLINED void add_splat(float* pixel, const __local BatchLight* light, uint k, float shape,
                       const CompositeParameters p) {
  const float deepest = light->deepest[k];
#if !KEEP_TRANSMITTANCE
  if (deepest <= p.phi_short) {
    add_thin_splat(pixel, light, k, shape);
    return;
  }
#endif
  const float4 layer = light->absorption_and_red[k];
  const float2 emission = light->green_and_blue[k];
  const int by_series = deepest <= p.phi_series;
  add_channel(pixel, 0, layer.w, layer.x, shape, by_series);
  add_channel(pixel, 1, emission.x, layer.y, shape, by_series);
  add_channel(pixel, 2, emission.y, layer.z, shape, by_series);
}
#else
INLINED void add_thin_splat(float* pixel, const __local BatchLight* light, uint k, float shape) {
  for (int i = 0; i < SUMMED / 3; ++i) {
    const float4 summed = light->summed[k * (SUMMED / 3) + i];
    pixel[3 * i] += shape * summed.x;
    pixel[3 * i + 1] += shape * summed.y;
    pixel[3 * i + 2] += shape * summed.z;
  }
}
#endif

#if FACE_OF_CUBE
INLINED float shape_at(const __local Batch* batch, const __local Listed* listed, uint k, uint x,
                       uint y TILE_PARAMETER) {
  const float dx = batch->axes[k * AXES + x], dy = batch->axes[k * AXES + TILE_WIDTH + y];
  if (dx == NOT_DRAWN || dy == NOT_DRAWN) return 0.0f;
  return face_shape(listed->splats[k].tilt, dx, dy, (on_face->x + (float)x) * on_face->per_focal,
                    (on_face->y + (float)y) * on_face->per_focal, on_face->cut2);
}
#else
INLINED float shape_at(const __local Batch* batch, const __local Listed* listed, uint k, uint x,
                       uint y) {
  const Axis column = batch->axes[k * AXES + x], row = batch->axes[k * AXES + TILE_WIDTH + y];
#ifdef CUT_BY_AXES
  return column.y <= row.y ? column.x * row.x : 0.0f;
#else
#if KERNEL_CUT
  if (!is_inside_cut(listed->splats + k, x, y)) return 0.0f;
#endif
  return column * row;
#endif
}
#endif

// The batch's splats of these bits, in order. Hardly any batch has layers that are not thin.
INLINED void draw(float* pixel, const __local Batch* batch, const __local Listed* listed, uint bits,
                  uint x, uint y, const CompositeParameters p TILE_PARAMETER,
                  const TileClouds* clouds) {
#if LIGHT_ORDERED
#if KEEP_TRANSMITTANCE
  const int all_thin = 0;
#else
  const int all_thin = (bits & bits_of_flags(&batch->thick)) == 0;
#endif
  while (!all_thin && bits != 0) {
    const uint k = take_first(&bits);
    const float sigma = listed->splats[k].sigma;
    const float shape = CLOUDS_IN_LISTS && is_cloud(sigma)
                            ? column_of_cloud(cloud_of(sigma, clouds), clouds, (int)x, (int)y)
                            : shape_at(batch, listed, k, x, y TILE_PASSED);
    if (shape > 0.0f) add_splat(pixel, &batch->light, k, shape, p);
  }
#endif
  while (bits != 0) {
    const uint k = take_first(&bits);
    add_thin_splat(pixel, &batch->light, k, shape_at(batch, listed, k, x, y TILE_PASSED));
  }
}

// A block of splats behind what is in front of it (ordered_list.cl, add_block()).
static inline void add_block(float* block, float* front) {
  add_layer(front, block);
  for (int c = 0; c < PLANES; ++c)
    block[c] = 0.0f;
}

// Whether a pixel lets anything through from behind: of a tile in which none does, the rest of the
// list is not drawn.
static inline int shows_behind(const float* front, float stop) {
#if LIGHT_ORDERED
  for (int c = 3; c < PLANES; ++c) {
    if (transmittance_of(front[c]) > stop) return 1;
  }
  return 0;
#else
  return 1;
#endif
}

__kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void composite(
    const CompositeParameters p, __global const Grid* grids, __global const Segment* segments,
    __global const TileSplat* entries, __global float* planes, __global float* partials,
    __global const ExtendedSplat* extended_splats, __global const CloudEntry* clouds,
    __global const CloudSplat* cloud_splats, __global const float* directions,
    __global const DirectionCone* cones, __global const Stencil* stencils) {
  __local Listed listed[2];
  __local Batch batch;
  __local uint shows;  // whether anything behind shows in any pixel
  const uint item = get_local_id(0), part = item / PART_ITEMS;
  // The launch has as many groups as there are segments.
  const Segment segment = segments[p.first_segment + get_group_id(0)];
  const uint grid_number = grid_of_tile(grids, p.grid_count, segment.tile);
  const Grid grid = grids[grid_number];
  __global const Stencil* const stencil = STENCILS ? stencil_of_grid(stencils, grid_number) : 0;
  const uint in_grid = segment.tile - grid.first_tile;
  const uint x = part % PARTS_ACROSS * PART_WIDTH + item % PART_WIDTH;
  const uint y = part / PARTS_ACROSS * PART_HEIGHT + item % PART_ITEMS / PART_WIDTH;
  __global float* own = planes + first_float(grid) +
                        ((size_t)(in_grid / (uint)grid.tiles_x) * TILE_HEIGHT + y) * grid.stride +
                        (size_t)(in_grid % (uint)grid.tiles_x) * TILE_WIDTH + x;
  const CloudTables tables = {clouds, cloud_splats, directions, cones};
  TileClouds of_tile;
  if (CLOUDS_IN_LISTS) of_tile = clouds_of_tile(tables, grid, segment.tile);
#if FACE_OF_CUBE
  const TileOnFace on_face = tile_on_face(p.face, grid, segment.tile);
#endif
  float front[PLANES], pixel[PLANES];
  for (int c = 0; c < PLANES; ++c) {
    front[c] = segment.partial == NO_PARTIAL ? own[(size_t)c * grid.plane_size] : 0.0f;
    pixel[c] = 0.0f;
  }
  if (item == 0) shows = 0;
  barrier(CLK_LOCAL_MEM_FENCE);
  if (shows_behind(front, p.stop)) atomic_or(&shows, 1u);
  barrier(CLK_LOCAL_MEM_FENCE);
  // Blocks are of splats that touch the tile: a crop's lists have others than those of the picture,
  // too. What decides over steps and barriers is the same for all items.
  uint in_block = 0, turn = 0, end = shows ? segment.end : segment.begin;
  for (uint first = segment.begin; first < end; first += BATCH) {
    const uint count = min((uint)BATCH, segment.end - first);
    __local Listed* own_listed = listed + turn;
    turn ^= 1u;
    fetch(own_listed, entries, first, count, grid.mean_sigma);
    barrier(CLK_LOCAL_MEM_FENCE);
    prepare(&batch, own_listed, count, grid.mean_sigma, p, &of_tile, stencil);
    if (item == 0) shows = 0;
    barrier(CLK_LOCAL_MEM_FENCE);
    const uint touching = bits_of_flags(&batch.touching);
    const uint drawn = bits_of_flags(batch.drawn + part);
    const int ends_block = in_block + popcount(touching) >= SPLATS_OF_BLOCK;
    // Splats that touch no pixel are drawn nowhere, so that all bits from there on serve.
    const uint of_next = ends_block ? bits_behind(touching, SPLATS_OF_BLOCK - in_block) : 0u;
    draw(pixel, &batch, own_listed, drawn & ~of_next, x, y, p TILE_ARGUMENT, &of_tile);
    in_block += popcount(touching);
    if (ends_block) {
      add_block(pixel, front);
      if (shows_behind(front, p.stop)) atomic_or(&shows, 1u);
      draw(pixel, &batch, own_listed, drawn & of_next, x, y, p TILE_ARGUMENT, &of_tile);
      in_block -= SPLATS_OF_BLOCK;
      barrier(CLK_LOCAL_MEM_FENCE);
      if (!shows) end = first;
    }
  }
  add_block(pixel, front);
  for (int c = 0; c < PLANES; ++c) {
    if (segment.partial == NO_PARTIAL) {
      own[(size_t)c * grid.plane_size] = front[c];
    } else {
      partials[((size_t)segment.partial * PLANES + c) * GROUP + y * TILE_WIDTH + x] = front[c];
    }
  }
}
