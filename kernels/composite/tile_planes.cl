// A segment's own copy of its tile, and the planes that it is added to.
#include "kernels/bin/bin.h"
#include "kernels/common/common.cl"
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#include "kernels/common/lanes.cl"
#include "kernels/composite/patch.cl"
#include "kernels/composite/planes.cl"
#include "kernels/composite/rows.cl"

// Sums of light, of which there are three, begin with nothing in every list and are added to what
// is there when they are stored: however many splats there are, those of one list only are added to
// a sum that is much larger than they are.
#if LIGHT_ORDERED
#define SUMS 3
#else
#define SUMS PLANES
#endif

static inline void clear_planes(float* tile) {
#pragma unroll 8
  for (int i = 0; i < PLANES * TILE_PIXELS; i += PATCH_WIDTH)
    store_patch((PATCH)(0.0f), tile + i);
}

// Where a tile is in the planes of its grid.
typedef struct TileInPlanes {
  __global float* corner;
  size_t plane_size, stride;
} TileInPlanes;

static inline TileInPlanes tile_in_planes(__global float* planes, const Grid grid, uint tile) {
  TileInPlanes place;
  place.corner = planes + first_of_tile(grid, tile);
  place.plane_size = grid.plane_size;
  place.stride = grid.stride;
  return place;
}

static inline __global float* row_of_tile(const TileInPlanes* place, int plane, int y) {
  return place->corner + (size_t)plane * place->plane_size + (size_t)y * place->stride;
}

// A tile's rows lie all over the planes: what is stored at the end is asked for while its splats
// are drawn, so many rows with each of them that no more are under way at a time than a processor
// keeps track of.
typedef struct RowsAhead {
  __global float* next;
  int left_of_plane, left;  // rows
  int with_each_entry;
} RowsAhead;

// Of a segment that is not stored in the planes none is asked for.
static inline RowsAhead rows_ahead(const Segment segment, const TileInPlanes* place) {
  const int all = PLANES * TILE_HEIGHT;
  RowsAhead rows;
  rows.next = place->corner;
  rows.left_of_plane = TILE_HEIGHT;
  rows.left = segment.partial == NO_PARTIAL ? all : 0;
  rows.with_each_entry = all / (int)(segment.end - segment.begin) + 1;
  return rows;
}

static inline void ask_for_rows(RowsAhead* rows, const TileInPlanes* place, int entries) {
  int count = min(entries * rows->with_each_entry, rows->left);
  rows->left -= count;
  for (; count > 0; --count) {
#pragma unroll
    for (int x = 0; x < TILE_WIDTH; x += NUMBERS_OF_LINE)
      ask_to_write(rows->next + x);
    rows->next += place->stride;
    if (--rows->left_of_plane > 0) continue;
    rows->left_of_plane = TILE_HEIGHT;
    rows->next += place->plane_size - TILE_HEIGHT * place->stride;
  }
}

static inline void store_tile(const float* tile, const TileInPlanes* place) {
  for (int c = 0; c < PLANES; ++c) {
    for (int y = 0; y < TILE_HEIGHT; ++y) {
      __global float* row = row_of_tile(place, c, y);
#pragma unroll
      for (int x = 0; x < TILE_WIDTH; x += 8) {
        const float8 drawn = load_eight(tile + c * TILE_PIXELS + y * ROW + x);
        store_global_eight(c < SUMS ? load_global_eight(row + x) + drawn : drawn, row + x);
      }
    }
  }
}

static inline void store_partial(const float* tile, __global float* partial) {
  for (int c = 0; c < PLANES; ++c) {
    for (int y = 0; y < TILE_HEIGHT; ++y) {
      for (int x = 0; x < TILE_WIDTH; x += 8) {
        store_global_eight(load_eight(tile + c * TILE_PIXELS + y * ROW + x),
                           partial + (c * TILE_HEIGHT + y) * TILE_WIDTH + x);
      }
    }
  }
}

INLINED void store_segment(const float* drawn, const Segment segment, const TileInPlanes* place,
                           __global float* partials) {
  if (segment.partial == NO_PARTIAL) {
    store_tile(drawn, place);
  } else {
    store_partial(drawn, partials + (size_t)segment.partial * PLANES * TILE_WIDTH * TILE_HEIGHT);
  }
}
