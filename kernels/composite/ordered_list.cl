// An ordered list, entry by entry: every layer lies behind those before it.
#include "kernels/bin/bin.h"
#include "kernels/bin/entry_lanes.cl"
#include "kernels/common/common.cl"
#include "kernels/common/ellipse.h"
#include "kernels/common/grid.h"
#include "kernels/common/lanes.cl"
#include "kernels/composite/clouds.cl"
#include "kernels/composite/composite.h"
#include "kernels/composite/entry_windows.cl"
#include "kernels/composite/narrow_splats.cl"
#include "kernels/composite/opacity.cl"
#include "kernels/composite/patch.cl"
#include "kernels/composite/rows.cl"
#include "kernels/composite/stencil.cl"
#include "kernels/composite/tile_planes.cl"
#include "kernels/composite/waiting.cl"
#if FACE_OF_CUBE
#include "kernels/composite/face_rows.cl"
#else
#include "kernels/composite/splat_rows.cl"
#endif

#if LIGHT_ORDERED

static inline void load_opacities(float* tile, const TileInPlanes* place) {
  for (int c = SUMS; c < PLANES; ++c) {
    for (int y = 0; y < TILE_HEIGHT; ++y) {
      __global const float* row = row_of_tile(place, c, y);
      for (int x = 0; x < TILE_WIDTH; x += 8) {
        store_eight(load_global_eight(row + x), tile + c * TILE_PIXELS + y * ROW + x);
      }
    }
  }
}

// A layer that is thinner than half a rounding of the opacity in front of it adds light, but no
// opacity. So layers are drawn by themselves in blocks (most_in_block), and n of them err by as
// many roundings and one for each block, not by n. Leaves nothing in the block.
static inline void add_block(float* block, float* front) {
  for (int i = 0; i < SUMS * TILE_PIXELS; i += PATCH_WIDTH) {
    const PATCH opacity = load_patch(front + SUMS * TILE_PIXELS + i);
    const PATCH behind = load_patch(block + SUMS * TILE_PIXELS + i);
    const PATCH t = transmittance_of(opacity);
    store_patch(load_patch(front + i) + t * load_patch(block + i), front + i);
    store_patch(carry_behind(opacity, t, behind), front + SUMS * TILE_PIXELS + i);
    store_patch((PATCH)(0.0f), block + i);
    store_patch((PATCH)(0.0f), block + SUMS * TILE_PIXELS + i);
  }
}

// The same of a list's only block, whose front is what is in the planes.
static inline void add_block_to_planes(const float* block, const TileInPlanes* place) {
  for (int c = 0; c < SUMS; ++c) {
    for (int y = 0; y < TILE_HEIGHT; ++y) {
      __global float* light = row_of_tile(place, c, y);
      __global float* opacities = row_of_tile(place, SUMS + c, y);
      const float* drawn = block + c * TILE_PIXELS + y * ROW;
      for (int x = 0; x < TILE_WIDTH; x += 8) {
        const float8 opacity = load_global_eight(opacities + x);
        const float8 behind = load_eight(drawn + SUMS * TILE_PIXELS + x);
        const float8 t = transmittance_of(opacity);
        store_global_eight(load_global_eight(light + x) + t * load_eight(drawn + x), light + x);
        store_global_eight(carry_behind(opacity, t, behind), opacities + x);
      }
    }
  }
}

#define CLOUD_ROWS(CHANNELS)                                     \
  for (int y = 0; y < TILE_HEIGHT; ++y) {                        \
    for (int x = 0; x < TILE_WIDTH; x += 8) {                    \
      const float8 shape = column_of_cloud(cloud, clouds, x, y); \
      if (!any(shape > 0.0f)) continue;                          \
      float* pixel = tile + y * ROW + x;                         \
      CHANNELS                                                   \
    }                                                            \
  }

// A call: hardly any entries are clouds. Whether it touches the tile.
__attribute__((noinline)) static int add_cloud(float* tile, __global const CloudEntry* cloud,
                                               const TileClouds* clouds, float* depth_of_block,
                                               const CompositeParameters* p) {
  if (!cloud_touches(cloud, clouds)) return 0;
  const float8 absorption0 = cloud->absorption[0], emission0 = cloud->emission[0];
  const float8 absorption1 = cloud->absorption[1], emission1 = cloud->emission[1];
  const float8 absorption2 = cloud->absorption[2], emission2 = cloud->emission[2];
  *depth_of_block += cloud->deepest;
  const int form = form_of_layer(cloud->deepest, *depth_of_block, p);
  if (form <= BY_THREE_TERMS) {
    CLOUD_ROWS(THIN_LAYER(COVERED_BY_THREE_TERMS))
  } else if (form == BY_SERIES) {
    CLOUD_ROWS(LAYER_CHANNELS(phi_series, passed_by_series))
  } else {
    CLOUD_ROWS(LAYER_CHANNELS(phi_full, passed_in_full))
  }
  return 1;
}

// Nothing behind shows any more: every channel of every pixel of the block behind the front is
// opaque enough. The front is what is in the planes where it is null. The first row that is not
// opaque says so of the tile.
static inline int is_opaque(const float* front, const TileInPlanes* place, const float* block,
                            float stop) {
  for (int c = SUMS; c < PLANES; ++c) {
    for (int y = 0; y < TILE_HEIGHT; ++y) {
      const int row = c * TILE_PIXELS + y * ROW;
      __global const float* row_of_planes = row_of_tile(place, c, y);
      float8 most = (float8)(0.0f);
      for (int x = 0; x < TILE_WIDTH; x += 8) {
        const float8 opacity =
            front ? load_eight(front + row + x) : load_global_eight(row_of_planes + x);
        most = max(most, transmittance_of(opacity) * transmittance_of(load_eight(block + row + x)));
      }
      const float4 four = max(most.lo, most.hi);
      const float2 two = max(four.lo, four.hi);
      if (!(max(two.x, two.y) <= stop)) return 0;
    }
  }
  return 1;
}

// What a splat of the list is drawn with.
typedef struct BlockOfLayers {
  float* tile;
  WaitingSplats* waiting;
  const SplatTile* of_tile;
  float* depth;  // the most that the depths of its splats come to
  float mean_sigma;
  const TileClouds* clouds;
} BlockOfLayers;

// What eight entries of the list are drawn by.
typedef struct LayerBatch {
  EntryWindows windows;
#ifdef NARROW_SPLATS
  NarrowSplats narrow;
#endif
} LayerBatch;

INLINED void find_layers(__global const TileSplat* entries, float mean_sigma, LayerBatch* batch) {
  const EntryLanes lanes = load_entries(entries);
  find_windows(lanes, entries, 0, &batch->windows);
#ifdef NARROW_SPLATS
  find_narrow_splats(lanes, 0, mean_sigma, &batch->windows, &batch->narrow);
#endif
}

// How a splat's layer is computed. Of the splats of a block up to this one, `depth_of_block` is the
// most that their depths come to.
INLINED int form_of_splat(__global const TileSplat* splat, float mean_sigma, float* depth_of_block,
                          const CompositeParameters* p) {
  const float sigma = splat->sigma, sigma_x = SIGMA_X(*splat);
  const float deepest = max(splat->absorption[0], max(splat->absorption[1], splat->absorption[2])) *
                        (sigma < mean_sigma ? min(1.0f, 3.15f * fabs(sigma * sigma_x)) : 1.0f);
  *depth_of_block += deepest;
  return form_of_layer(deepest, *depth_of_block, p);
}

// Whether the entry touches the tile: lists have splats that do not, too (splat.h), and those of a
// crop other ones.
INLINED int draw_layer(const BlockOfLayers block, __global const TileSplat* entry,
                       const LayerBatch* batch, int in_batch, const CompositeParameters* p) {
  if (CLOUDS_IN_LISTS && is_cloud(entry->sigma)) {
    add_waiting(block.tile, block.waiting);
    return add_cloud(block.tile, cloud_of(entry->sigma, block.clouds), block.clouds, block.depth,
                     p);
  }
  const int2 rows = rows_of_entry(&batch->windows, in_batch);
  const int2 columns = columns_of_entry(&batch->windows, in_batch);
  if (rows.x > rows.y || columns.x > columns.y) return 0;
  const int form = form_of_splat(entry, block.mean_sigma, block.depth, p);
  if (let_wait_if_it_does(block.tile, block.waiting, rows, columns, entry, block.mean_sigma, form))
    return 1;
#ifdef NARROW_SPLATS
  if (batch->narrow.pixels[in_batch] != 0) {
    add_narrow_splat(block.tile, &batch->narrow, in_batch, entry, form);
    return 1;
  }
#endif
  add_splat(block.tile, entry, rows, columns, block.of_tile, form);
  return 1;
}

#define SPLATS_UNTIL_OPAQUE 256u  // drawn before the tile is looked at again

INLINED void draw_list(float* tile, const Segment segment, const TileInPlanes* place,
                       __global const Grid* grid, uint grid_number,
                       __global const TileSplat* entries, __global float* partials,
                       const CompositeParameters* p, const CloudTables* clouds,
                       __global const Stencil* stencils, PATCH lanes) {
  const SplatTile of_tile = splat_tile(*grid, segment.tile, p);
  // Most lists of a large frame's many chunks: they need no front of their own.
  const int is_one_block =
      segment.partial == NO_PARTIAL && segment.end - segment.begin < p->most_in_block;
  float front[PLANES * TILE_PIXELS];
  if (!is_one_block) clear_planes(front);
  if (!is_one_block && segment.partial == NO_PARTIAL) load_opacities(front, place);
  const float* const own_front = is_one_block ? 0 : front;
  WaitingSplats waiting;
  clear_waiting(&waiting);
  waiting.forms.first = p->phi_first;
  waiting.forms.second = p->phi_short;
  float depth = 0.0f;
  BlockOfLayers block;
  block.tile = tile;
  block.waiting = &waiting;
  block.of_tile = &of_tile;
  block.depth = &depth;
  block.mean_sigma = grid->mean_sigma;
  TileClouds clouds_here;
  if (CLOUDS_IN_LISTS) clouds_here = clouds_of_tile(*clouds, *grid, segment.tile);
  block.clouds = &clouds_here;
  RowsAhead rows = rows_ahead(segment, place);
  LayerBatch batch;
  const uint end = is_opaque(own_front, place, tile, p->stop) ? segment.begin : segment.end;
  for (uint k = segment.begin, drawn = 0; k < end; ++k) {
    const int in_batch = (int)((k - segment.begin) % LANES);
    if (in_batch == 0) {
      ask_for_entries(entries + k + ENTRIES_AHEAD);
      find_layers(entries + k, block.mean_sigma, &batch);
    }
    ask_for_rows(&rows, place, 1);
    if (!draw_layer(block, entries + k, &batch, in_batch, p)) continue;
    ++drawn;
    if (drawn % SPLATS_UNTIL_OPAQUE == 0u) {
      add_waiting(tile, &waiting);
      if (is_opaque(own_front, place, tile, p->stop)) break;
    }
    if (drawn % p->most_in_block == 0u) {
      add_waiting(tile, &waiting);
      add_block(tile, front);
      depth = 0.0f;
    }
  }
  add_waiting(tile, &waiting);
  if (is_one_block) {
    add_block_to_planes(tile, place);
    return;
  }
  add_block(tile, front);
  store_segment(front, segment, place, partials);
}
#endif
