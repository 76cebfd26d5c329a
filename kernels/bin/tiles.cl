// Which tiles a splat is listed in: found once, by the projection where splats are binned as they
// come, else by the counting of the sorted ones, and kept in a word per splat.
#include "kernels/common/common.cl"
#include "kernels/common/ellipse.h"
#include "kernels/common/grid.h"
#include "kernels/common/splat.cl"
#include "kernels/common/splat.h"

// Those of a grid's tiles that are in memory.
INLINED int4 tiles_in_memory(int4 range, const Grid grid) {
  const int column = grid.first_x / TILE_WIDTH, row = grid.first_y / TILE_HEIGHT;
  const int4 part = (int4)(max(range.x, column), min(range.y, column + grid.tiles_x - 1),
                           max(range.z, row), min(range.w, row + grid.tiles_y - 1));
  return part.z > part.w ? (int4)(0, -1, 0, -1) : part;
}

INLINED float2 center_on_grid(const Splat splat, const Grid grid) {
  return (float2)((float)splat.x, (float)splat.y) * unit_of(splat, grid) +
         (float2)((float)grid.middle_x, (float)grid.middle_y);
}

// The tile next to a splat that is only listed (splat.h), or that touches none: the check after
// drawing is to know of it. Of those from `first` on, so many pixels.
INLINED int4 nearest_tile(const Splat splat, float2 first, float2 size, const Grid grid) {
  const float2 nearest = min(max(center_on_grid(splat, grid), first), first + size - 1.0f);
  const int column = (int)nearest.x / TILE_WIDTH, row = (int)nearest.y / TILE_HEIGHT;
  return (int4)(column, column, row, row);
}

INLINED int4 tile_beside(const Splat splat, const Grid grid) {
  const int columns = (grid.width + TILE_WIDTH - 1) / TILE_WIDTH;
  const int rows = (grid.height + TILE_HEIGHT - 1) / TILE_HEIGHT;
  const float2 size = (float2)((float)(columns * TILE_WIDTH), (float)(rows * TILE_HEIGHT));
  return nearest_tile(splat, (float2)(0.0f, 0.0f), size, grid);
}

// The same of the tiles in memory.
INLINED int4 tile_in_memory_beside(const Splat splat, const Grid grid) {
  const float2 first = (float2)((float)grid.first_x, (float)grid.first_y);
  const float2 size =
      (float2)((float)(grid.tiles_x * TILE_WIDTH), (float)(grid.tiles_y * TILE_HEIGHT));
  return nearest_tile(splat, first, size, grid);
}

// In which lists a splat is. Where it is in none of those of the tiles in memory, but only in
// others of the whole picture, it is in the list beside it, behind all that belong there: lists are
// cut by their length, and those of a crop are to be cut as those of the picture.
typedef struct ListedTiles {
  int4 range;
  int is_behind;
} ListedTiles;

INLINED ListedTiles listed_tiles(int4 in_picture, const Splat splat, const Grid grid) {
  ListedTiles listed;
  listed.range = in_picture;
  listed.is_behind = 0;
  if (!grid.is_part) return listed;
  listed.range = tiles_in_memory(in_picture, grid);
  listed.is_behind = listed.range.x > listed.range.y;
  if (listed.is_behind) listed.range = tile_in_memory_beside(splat, grid);
  return listed;
}

// First and last pixels (tiles_in_picture) of a splat so wide that its units are pixels or more, or
// that its radius is beyond integers. First pixels are turned round, so that first and last ones
// are found alike: the last whole number below, as floor() is a call on PoCL. Clamped before the
// conversion: a splat close to the camera may lie anywhere.
static inline int4 pixels_of_wide(const Splat splat, const Grid grid) {
  const float2 center = center_on_grid(splat, grid);
  const float2 radius = (float2)(RADIUS_X(splat), splat.radius) + grid.room;
  const float2 size = (float2)((float)grid.width, (float)grid.height);
  const float4 ends = (float4)(0.5f - center, center - 0.5f) + radius.xyxy;
  const float4 clamped =
      min(max(ends, (float4)(-size, -1.0f, -1.0f)), (float4)(0.0f, 0.0f, size - 1.0f));
  const int4 truncated = convert_int4(clamped);
  const int4 pixels = truncated + (convert_float4(truncated) > clamped);
  return (int4)(-pixels.x, pixels.z, -pixels.y, pixels.w);
}

// First and last pixel whose centers lie within `radius` units of 2^-bits pixels of a place, as if
// the grid had no end.
INLINED int2 pixels_within(int place, int radius, int middle, int bits) {
  const int to_center = 1 << (bits - 1), almost_one = (1 << bits) - 1;
  return (int2)(((place - radius - to_center + almost_one) >> bits) + middle,
                ((place + radius - to_center) >> bits) + middle);
}

// Tiles of its grid in the whole picture that a splat's square touches, or the one beside it: x
// range in .x .y, y range in .z .w. With room for the rounding of the center; compositing knows it
// better.
INLINED int4 tiles_in_picture(const Splat splat, const Grid grid) {
  if (splat.radius < 0.0f) return tile_beside(splat, grid);
  const int bits = place_bits_of(splat, grid);
  const float most_units = 1073741000.0f;  // as places are
  const float units_per_pixel = as_float((127 + bits) << 23);
  const float units = (splat.radius + grid.room) * units_per_pixel;
  const float units_x = (RADIUS_X(splat) + grid.room) * units_per_pixel;
  int first_x, last_x, first_y, last_y;
  if (bits <= 0 || units >= most_units || units_x >= most_units) {
    const int4 pixels = pixels_of_wide(splat, grid);
    first_x = pixels.x, last_x = pixels.y, first_y = pixels.z, last_y = pixels.w;
  } else {
    // Rounded up.
    const int2 columns = pixels_within(splat.x, (int)units_x + 1, grid.middle_x, bits);
    const int2 rows = pixels_within(splat.y, (int)units + 1, grid.middle_y, bits);
    first_x = columns.x > 0 ? columns.x : 0;
    last_x = columns.y < grid.width ? columns.y : grid.width - 1;
    first_y = rows.x > 0 ? rows.x : 0;
    last_y = rows.y < grid.height ? rows.y : grid.height - 1;
  }
  if (first_x > last_x || first_y > last_y) return tile_beside(splat, grid);
  return (int4)((uint)first_x / TILE_WIDTH, (uint)last_x / TILE_WIDTH, (uint)first_y / TILE_HEIGHT,
                (uint)last_y / TILE_HEIGHT);
}

INLINED ListedTiles find_lists(const Splat splat, const Grid grid) {
  return listed_tiles(tiles_in_picture(splat, grid), splat, grid);
}

// A range of tiles in a word: the first column and row, and how many of both. Ranges that do not
// fit are found again, and those of splats in coarser units than their grid's, or of a pixel and
// more, or behind all others of a list.
#define FIRST_TILE_BITS 10
#define TILE_COUNT_BITS 6
#define FOUND_AGAIN 0xffffffffu
#define ONE_TILE (1u << 2 * FIRST_TILE_BITS | 1u << (2 * FIRST_TILE_BITS + TILE_COUNT_BITS))

static inline uint pack_tiles(const ListedTiles listed) {
  const int4 range = listed.range;
  const int columns = range.y - range.x + 1, rows = range.w - range.z + 1;
  const int fits = !listed.is_behind && max(range.x, range.z) < 1 << FIRST_TILE_BITS &&
                   max(columns, rows) < (1 << TILE_COUNT_BITS) - 1;
  if (!fits) return FOUND_AGAIN;
  return (uint)range.x | (uint)range.z << FIRST_TILE_BITS | (uint)columns << 2 * FIRST_TILE_BITS |
         (uint)rows << (2 * FIRST_TILE_BITS + TILE_COUNT_BITS);
}

static inline uint first_column_of_tiles(uint packed) {
  return packed & ((1u << FIRST_TILE_BITS) - 1u);
}
static inline uint first_row_of_tiles(uint packed) {
  return packed >> FIRST_TILE_BITS & ((1u << FIRST_TILE_BITS) - 1u);
}
static inline uint columns_of_tiles(uint packed) {
  return packed >> 2 * FIRST_TILE_BITS & ((1u << TILE_COUNT_BITS) - 1u);
}
static inline uint rows_of_tiles(uint packed) {
  return packed >> (2 * FIRST_TILE_BITS + TILE_COUNT_BITS);
}

// Not of FOUND_AGAIN.
INLINED int4 unpack_tiles(uint packed) {
  const int x = (int)first_column_of_tiles(packed), y = (int)first_row_of_tiles(packed);
  const int columns = (int)columns_of_tiles(packed), rows = (int)rows_of_tiles(packed);
  return (int4)(x, x + columns - 1, y, y + rows - 1);
}

INLINED uint tiles_of(const Splat splat, const Grid grid) {
  if (grid.place_bits <= 0 || coarser_of(splat) > 0) return FOUND_AGAIN;
  return pack_tiles(find_lists(splat, grid));
}

// Where those in the whole picture are not known, or not all of them are in memory. A call, as the
// next but one: hardly any splats of a whole picture need them.
__attribute__((noinline)) static uint tiles_found_again(uint in_picture, __global const Splat* from,
                                                        __global const Grid* of_splat) {
  const Splat splat = *from;
  const Grid grid = *of_splat;
  if (in_picture == FOUND_AGAIN) return tiles_of(splat, grid);
  return pack_tiles(listed_tiles(unpack_tiles(in_picture), splat, grid));
}

// Of a splat whose tiles in the whole picture are known, unless they are FOUND_AGAIN.
INLINED uint tiles_in_lists(uint in_picture, __global const Splat* splat,
                            __global const Grid* grid) {
  if (in_picture != FOUND_AGAIN && !grid->is_part) return in_picture;
  return tiles_found_again(in_picture, splat, grid);
}

// What a block counts in each tile, and of it behind all others of a list. Where all tiles are in
// memory there is no room for the latter, nor need of it.
typedef struct CountedTiles {
  __global uint *tiles, *behind;
} CountedTiles;

INLINED CountedTiles counted_tiles(__global uint* counts, uint block, uint block_count,
                                   uint tile_count) {
  CountedTiles counted;
  counted.tiles = counts + (size_t)block * tile_count;
  counted.behind = counted.tiles + (size_t)block_count * tile_count;
  return counted;
}

INLINED void clear_counts(const CountedTiles counted, uint tile_count, int has_parts) {
  for (uint t = 0; t < tile_count; ++t)
    counted.tiles[t] = 0;
  for (uint t = 0; has_parts && t < tile_count; ++t)
    counted.behind[t] = 0;
}

__attribute__((noinline)) static void count_one_by_one(__global const Splat* splat,
                                                       __global const Grid* grid,
                                                       const CountedTiles counted) {
  const ListedTiles listed = find_lists(*splat, *grid);
  const int4 range = listed.range;
  __global uint* count = listed.is_behind ? counted.behind : counted.tiles;
  for (int ty = range.z; ty <= range.w; ++ty) {
    for (int tx = range.x; tx <= range.y; ++tx)
      ++count[grid->corner_tile + (uint)(ty * grid->tiles_x + tx)];
  }
}

// Splats that touch several tiles, which are counted some at a time: a processor does not foresee
// which splats these are.
#define MOST_WAITING 8
typedef struct WaitingCounts {
  uint count;
  uint tiles[MOST_WAITING], corner[MOST_WAITING], tiles_x[MOST_WAITING];
} WaitingCounts;

INLINED WaitingCounts no_waiting_counts(void) {
  WaitingCounts waiting;
  waiting.count = 0;
  return waiting;
}

// Counts a splat of several tiles in all but the first, at `first`, which has counted it.
INLINED void count_behind_first(uint tiles, uint tiles_x, __global uint* first) {
  const uint columns = columns_of_tiles(tiles), rows = rows_of_tiles(tiles);
  // Most have two, the last of which is the second.
  ++first[(rows - 1) * tiles_x + columns - 1];
  if (columns + rows == 3) return;
  const uint others = columns * rows - 1;
  uint x = 1 % columns, y = 1 / columns;
  for (uint k = 1; k < others; ++k) {
    ++first[y * tiles_x + x];
    const uint is_last = x == columns - 1;
    x = is_last ? 0 : x + 1;
    y += is_last;
  }
}

INLINED void count_waiting(WaitingCounts* waiting, __global uint* count) {
  for (uint i = 0; i < waiting->count; ++i)
    count_behind_first(waiting->tiles[i], waiting->tiles_x[i], count + waiting->corner[i]);
  waiting->count = 0;
}

INLINED uint has_several_tiles(uint packed) {
  return packed >> 2 * FIRST_TILE_BITS != ONE_TILE >> 2 * FIRST_TILE_BITS;
}

// Counts a splat in the tiles that it touches, at the latest when those that wait are counted. One
// that is not visible, of ONE_TILE, counts for nothing.
INLINED void count_in_tiles(uint tiles, __global const Splat* splat, __global const Grid* grid,
                            uint is_visible, const CountedTiles counted, WaitingCounts* waiting) {
  if (tiles == FOUND_AGAIN) {
    count_one_by_one(splat, grid, counted);
    return;
  }
  __global uint* count = counted.tiles;
  const uint tiles_x = (uint)grid->tiles_x;
  const uint corner =
      grid->corner_tile + first_row_of_tiles(tiles) * tiles_x + first_column_of_tiles(tiles);
  count[corner] += is_visible;
  const uint last = waiting->count;
  waiting->tiles[last] = tiles;
  waiting->corner[last] = corner;
  waiting->tiles_x[last] = tiles_x;
  waiting->count = last + has_several_tiles(tiles);
  if (waiting->count == MOST_WAITING) count_waiting(waiting, count);
}
