// Compositing for GPUs: a work-group takes a segment of one tile's list, a work-item four pixels,
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
#include "kernels/composite/opacity.cl"
#include "kernels/composite/pixel_range.cl"
#include "kernels/composite/planes.cl"
#include "kernels/composite/shape.cl"
#include "kernels/composite/stencil.cl"
#include "kernels/composite/tile_batch.cl"

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
// As THIN_CHANNEL and LAYER_CHANNEL of composite_rows.cl. `covered` is the shape times phi.
static inline void add_thin_channel(float* pixel, int c, float emission, float absorption,
                                    float covered) {
  const float opacity = pixel[c + 3];
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

INLINED void add_thinnest_splat(float* pixel, const __local BatchLight* light, uint k,
                                float shape) {
  const float4 layer = light->absorption_and_red[k];
  const float2 emission = light->green_and_blue[k];
  add_thin_channel(pixel, 0, layer.w, layer.x, shape);
  add_thin_channel(pixel, 1, emission.x, layer.y, shape);
  add_thin_channel(pixel, 2, emission.y, layer.z, shape);
}

// With the bits of add_thinnest_splat() where one term serves: no splat's depend on its batch.
INLINED void add_thin_splat(float* pixel, const __local BatchLight* light, uint k, float shape) {
  const float4 layer = light->absorption_and_red[k];
  const float2 emission = light->green_and_blue[k];
  const float square = light->second_term[k] * (shape * shape);
  add_thin_channel(pixel, 0, layer.w, layer.x, shape - square * layer.x);
  add_thin_channel(pixel, 1, emission.x, layer.y, shape - square * layer.y);
  add_thin_channel(pixel, 2, emission.y, layer.z, shape - square * layer.z);
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
INLINED void add_thinnest_splat(float* pixel, const __local BatchLight* light, uint k,
                                float shape) {
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
  if (DISCS_BY_PIXEL) {
    const float4 disc = batch->discs[k];
    const float dx = (float)x + FIRST_X - disc.x, dy = (float)y + FIRST_Y - disc.y;
    const float square = dx * dx + dy * dy;
    return square <= disc.z ? exp2_negative(square * -disc.w) : 0.0f;
  }
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

// The batch's splats of these bits, in order, in an item's pixels of a part, from (x, y) down.
// Hardly any batch has layers that are not thin.
INLINED void draw(float* pixels, const __local Batch* batch, const __local Listed* listed,
                  uint bits, uint x, uint y, const CompositeParameters p TILE_PARAMETER,
                  const TileClouds* clouds) {
#if LIGHT_ORDERED
  const int all_thin = !KEEP_TRANSMITTANCE && (bits & bits_of_flags(&batch->thick)) == 0;
  while (!all_thin && bits != 0) {
    const uint k = take_first(&bits);
    const float sigma = listed->splats[k].sigma;
#pragma unroll
    for (uint i = 0; i < ITEM_HEIGHT; ++i) {
      const float shape =
          CLOUDS_IN_LISTS && is_cloud(sigma)
              ? column_of_cloud(cloud_of(sigma, clouds), clouds, (int)x, (int)(y + i))
              : shape_at(batch, listed, k, x, y + i TILE_PASSED);
      if (shape > 0.0f) add_splat(pixels + i * PLANES, &batch->light, k, shape, p);
    }
  }
  const int all_thinnest = (bits & bits_of_flags(&batch->of_two_terms)) == 0;
  while (!all_thinnest && bits != 0) {
    const uint k = take_first(&bits);
#pragma unroll
    for (uint i = 0; i < ITEM_HEIGHT; ++i) {
      const float shape = shape_at(batch, listed, k, x, y + i TILE_PASSED);
      add_thin_splat(pixels + i * PLANES, &batch->light, k, shape);
    }
  }
#endif
  while (bits != 0) {
    const uint k = take_first(&bits);
#pragma unroll
    for (uint i = 0; i < ITEM_HEIGHT; ++i) {
      const float shape = shape_at(batch, listed, k, x, y + i TILE_PASSED);
      add_thinnest_splat(pixels + i * PLANES, &batch->light, k, shape);
    }
  }
}

// The tile's pixels in the planes, or in its segment's own layer. Read from local memory when they
// are needed: a compiler would keep addresses of all of an item's numbers in registers.
typedef struct PixelPlaces {
  __global float* first;
  size_t plane, row;
} PixelPlaces;

INLINED __global float* pixel_of_tile(const __local PixelPlaces* places, uint x, uint y) {
  return places->first + y * places->row + x;
}

// Whether a pixel lets anything through from behind: of a tile in which none does, the rest of the
// list is not drawn.
static inline int shows_behind(const float* pixel, float stop) {
#if LIGHT_ORDERED
  for (int c = 3; c < PLANES; ++c) {
    if (transmittance_of(pixel[c]) > stop) return 1;
  }
  return 0;
#else
  return 1;
#endif
}

// The row of an item's pixel, from its first one.
#define ROW_OF_PIXEL(i) ((i) / ITEM_HEIGHT * ROWS_TO_NEXT + (i) % ITEM_HEIGHT)

INLINED void load_pixel(__global const float* from, size_t plane, int is_empty, float* pixel) {
  for (int c = 0; c < PLANES; ++c)
    pixel[c] = is_empty ? 0.0f : from[c * plane];
}

// A block of splats behind what is in front of it (ordered_list.cl, add_block()), which few splats
// need: it is read and written where it lies, unless there is nothing yet. Returns whether anything
// shows behind both.
INLINED int add_block(float* block, const __local PixelPlaces* places, int is_empty, uint x, uint y,
                      float stop) {
  int shows = 0;
#pragma unroll
  for (uint i = 0; i < PIXELS_OF_ITEM; ++i) {
    float front[PLANES];
    __global float* at = pixel_of_tile(places, x, y + ROW_OF_PIXEL(i));
    load_pixel(at, places->plane, is_empty, front);
    add_behind(front, block + i * PLANES);
    for (int c = 0; c < PLANES; ++c) {
      at[c * places->plane] = front[c];
      block[i * PLANES + c] = 0.0f;
    }
    shows |= shows_behind(front, stop);
  }
  return shows;
}

INLINED int any_shows_behind(const float* block, float stop) {
  int shows = 0;
#pragma unroll
  for (uint i = 0; i < PIXELS_OF_ITEM; ++i)
    shows |= shows_behind(block + i * PLANES, stop);
  return shows;
}

// Splats that touch the tile, until it is looked at whether anything behind them shows.
#define MOST_IN_STRETCH 64u

__kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void composite(COMPOSITE_PARAMETERS) {
  __local Listed listed[2];
  __local Batch batch;
  __local PixelPlaces places;
  __local uint shows;  // whether anything behind shows in any pixel
  const uint item = get_local_id(0), part = item / PART_ITEMS;
  // The launch has as many groups as there are segments.
  const Segment segment = segments[p.first_segment + get_group_id(0)];
  const uint grid_number = grid_of_tile(grids, p.grid_count, segment.tile);
  const Grid grid = grids[grid_number];
  __global const Stencil* const stencil = STENCILS ? stencil_of_grid(stencils, grid_number) : 0;
  const uint x = part % PARTS_ACROSS * PART_WIDTH + item % PART_WIDTH;
  const uint y = part / PARTS_ACROSS * PART_HEIGHT + item % PART_ITEMS / PART_WIDTH * ITEM_HEIGHT;
  const CloudTables tables = {clouds, cloud_splats, directions, cones};
  TileClouds of_tile;
  if (CLOUDS_IN_LISTS) of_tile = clouds_of_tile(tables, grid, segment.tile);
#if FACE_OF_CUBE
  const TileOnFace on_face = tile_on_face(p.face, grid, segment.tile);
#endif
  float block[PIXELS_OF_ITEM * PLANES];
  for (uint i = 0; i < PIXELS_OF_ITEM * PLANES; ++i)
    block[i] = 0.0f;
  const int is_partial = segment.partial != NO_PARTIAL;
  int is_empty = is_partial;
  if (item == 0) {
    shows = 0;
    places.row = is_partial ? TILE_WIDTH : grid.stride;
    places.plane = is_partial ? TILE_PIXELS : grid.plane_size;
    places.first = is_partial ? partials + (size_t)segment.partial * PLANES * TILE_PIXELS
                              : planes + first_of_tile(grid, segment.tile);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint i = 0; i < PIXELS_OF_ITEM; ++i) {
    float front[PLANES];
    load_pixel(pixel_of_tile(&places, x, y + ROW_OF_PIXEL(i)), places.plane, is_empty, front);
    if (shows_behind(front, p.stop)) atomic_or(&shows, 1u);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  // Blocks and stretches are of splats that touch the tile: a crop's lists have others than those
  // of the picture, too. What decides over steps and barriers is the same for all items.
  const uint most = min(MOST_IN_STRETCH, p.most_in_block);
  uint in_stretch = 0, in_block = 0, turn = 0, end = shows ? segment.end : segment.begin;
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
    in_stretch += popcount(touching);
    int ends_stretch = in_stretch >= most;
    // Splats that touch no pixel are drawn nowhere, so that all bits from there on serve.
    uint now = 0xffffffffu;
    if (ends_stretch) now = ~bits_behind(touching, most + popcount(touching) - in_stretch);
    for (;;) {
#pragma unroll
      for (uint i = 0; i < PARTS_OF_ITEM; ++i) {
        const uint drawn = bits_of_flags(batch.drawn + part + i * PARTS_TO_NEXT);
        draw(block + i * ITEM_HEIGHT * PLANES, &batch, own_listed, drawn & now, x,
             y + i * ROWS_TO_NEXT, p TILE_ARGUMENT, &of_tile);
      }
      if (!ends_stretch) break;
      in_stretch -= most;
      in_block += most;
      const int ends_block = in_block >= p.most_in_block;
      if (ends_block) in_block = 0;
      if (ends_block ? add_block(block, &places, is_empty, x, y, p.stop)
                     : any_shows_behind(block, p.stop))
        atomic_or(&shows, 1u);
      if (ends_block) is_empty = 0;
      barrier(CLK_LOCAL_MEM_FENCE);
      if (!shows) end = first;
      now = shows ? ~now : 0u;
      ends_stretch = 0;
    }
  }
  add_block(block, &places, is_empty, x, y, p.stop);
}
