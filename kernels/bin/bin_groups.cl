// Splats to lists per tile for GPUs: a work-item per splat finds its tiles, one per entry writes
// the entry's tile and splat in the splats' order, the stable sort of the stage `sort` puts these
// in the order of tiles, and a work-item per entry makes it.
#include "kernels/bin/bin.h"
#include "kernels/bin/entries.cl"
#include "kernels/bin/tiles.cl"
#include "kernels/common/common.cl"
#include "kernels/common/grid.h"
#include "kernels/common/group_sums.cl"
#include "kernels/common/splat.cl"
#include "kernels/common/splat.h"
#include "kernels/project/project.h"

// Those of a chunk, numbered as they are listed.
INLINED uint splat_count(const BinParameters p) {
  return p.end - p.first;
}

INLINED SplatTiles tiles_of_splat(const Splat splat, const Grid grid) {
  const ListedTiles listed = find_lists(splat, grid);
  const int4 range = listed.range;
  SplatTiles tiles;
  tiles.first = grid.corner_tile + (uint)(range.z * grid.tiles_x + range.x);
  tiles.columns = (uint)(range.y - range.x + 1);
  tiles.rows = (uint)(range.w - range.z + 1);
  tiles.grid_columns = listed.is_behind ? BEHIND_OTHERS : (uint)grid.tiles_x;
  return tiles;
}

// Counts a splat in its tiles: in each of a few, else in `corners`, from whose sums over columns
// and rows the host finds the counts.
INLINED void count_in_groups(const SplatTiles tiles, const Grid grid, __global uint* counts,
                             __global uint* corners) {
  const uint columns = tiles.columns, rows = tiles.rows;
  if (columns * rows <= FEW_TILES) {
    for (uint k = 0; k < columns * rows; ++k)
      atomic_inc(&counts[tiles.first + k / columns * tiles.grid_columns + k % columns]);
    return;
  }
  const uint in_grid = tiles.first - grid.first_tile;
  const int ends_right = in_grid % tiles.grid_columns + columns == (uint)grid.tiles_x;
  const int ends_below = in_grid / tiles.grid_columns + rows == (uint)grid.tiles_y;
  __global uint* first = corners + tiles.first;
  __global uint* below = first + rows * tiles.grid_columns;
  atomic_inc(first);
  if (!ends_right) atomic_dec(first + columns);
  if (!ends_below) atomic_dec(below);
  if (!ends_right && !ends_below) atomic_inc(below + columns);
}

// `counts` has room for all tiles twice, in each of its copies, and is 0 at first.
__kernel OF_GROUPS void bin_find_tiles(const GroupBinParameters p, __global const Grid* grids,
                                       __global const Splat* splats, __global const uint* order,
                                       __global SplatTiles* tiles, __global uint* counts) {
  const uint number = get_global_id(0);
  if (number >= splat_count(p.bin)) return;
  const Splat splat = splats[order[p.bin.first + number]];
  const Grid grid = grids[grid_of(splat)];
  const SplatTiles found = tiles_of_splat(splat, grid);
  tiles[number] = found;
  __global uint* own =
      counts + (size_t)(get_group_id(0) % COPIES_OF_COUNTS) * (2u * p.bin.tile_count);
  count_in_groups(found, grid, own, own + p.bin.tile_count);
}

// Adds all copies of a count to the first.
__kernel OF_GROUPS void bin_add_counts(const GroupBinParameters p, __global uint* counts) {
  const uint i = get_global_id(0), all = 2u * p.bin.tile_count;
  if (i >= all) return;
  uint sum = 0;
  for (uint copy = 0; copy < COPIES_OF_COUNTS; ++copy)
    sum += counts[(size_t)copy * all + i];
  counts[i] = sum;
}

// Of the splat's tiles, row by row, those before this one.
INLINED uint tiles_before(const SplatTiles tiles, uint tile) {
  if (tile <= tiles.first) return 0;
  const uint row = (tile - tiles.first) / tiles.grid_columns;
  const uint column = (tile - tiles.first) % tiles.grid_columns;
  return row < tiles.rows ? row * tiles.columns + min(column, tiles.columns)
                          : tiles.rows * tiles.columns;
}

// How many entries each splat has in the band.
__kernel OF_GROUPS void bin_count_entries(const GroupBinParameters p,
                                          __global const SplatTiles* tiles,
                                          __global uint* entry_counts) {
  const uint number = get_global_id(0);
  if (number >= splat_count(p.bin)) return;
  const SplatTiles own = tiles[number];
  entry_counts[number] = tiles_before(own, p.bin.end_tile) - tiles_before(own, p.bin.first_tile);
}

// The last splat from `low` on and before `end` whose entries begin at this one or before: it has
// it.
INLINED uint splat_of_entry(__global const uint* first_entries, uint low, uint end, uint entry) {
  uint high = end;
  while (high - low > 1) {
    const uint middle = low + (high - low) / 2;
    if (first_entries[middle] <= entry) {
      low = middle;
    } else {
      high = middle;
    }
  }
  return low;
}

// Entries in the order of splats, and of each splat in that of tiles. Where there are crops, the
// tile's number has a bit more: those that come behind all others of its list. The splats of a
// group's first and last entry are looked for among all, the others between them.
__kernel OF_GROUPS void bin_emit(const GroupBinParameters p, __global const uint* order,
                                 __global const SplatTiles* tiles,
                                 __global const uint* first_entries,
                                 __global uint* tiles_of_entries,
                                 __global uint* splats_of_entries) {
  __local uint ends[2];
  const uint item = get_local_id(0), first = get_group_id(0) * GROUP_ITEMS;
  const uint last = min(first + GROUP_ITEMS, p.entry_count) - 1u, entry = first + item;
  if (item < 2) {
    ends[item] = splat_of_entry(first_entries, 0, splat_count(p.bin), item == 0 ? first : last);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  if (entry > last) return;
  const uint number = splat_of_entry(first_entries, ends[0], ends[1] + 1, entry);
  const SplatTiles own = tiles[number];
  const uint k = entry - first_entries[number] + tiles_before(own, p.bin.first_tile);
  const uint tile = own.first + k / own.columns * own.grid_columns + k % own.columns;
  tiles_of_entries[entry] =
      (tile - p.bin.first_tile) << p.bin.has_parts | (own.grid_columns == BEHIND_OTHERS);
  splats_of_entries[entry] = order[p.bin.first + number];
}

INLINED TileSplat entry_of(const BinParameters p, uint slot, const Splat splat, const Grid grid,
                           uint tile, __global const ComponentColors* component_colors,
                           __global const float* knots) {
  const uint in_grid = tile - grid.first_tile;
  const int column = (int)(in_grid % (uint)grid.tiles_x), row = (int)(in_grid / (uint)grid.tiles_x);
  const int middle_x = grid.first_x + column * TILE_WIDTH + TILE_WIDTH / 2;
  const int middle_y = grid.first_y + row * TILE_HEIGHT + TILE_HEIGHT / 2;
  TileSplat entry =
      entry_without_place(splat, slot, component_colors[component_of(splat)], knots, p);
  set_place(&entry, splat, grid, (int2)(middle_x, middle_y));
  return entry;
}

// A group writes its entries together, word by word.
#define ENTRY_WORDS (sizeof(TileSplat) / sizeof(uint))

__kernel OF_GROUPS void bin_make_entries(const GroupBinParameters p, __global const Grid* grids,
                                         __global const Splat* splats,
                                         __global const uint* tiles_of_entries,
                                         __global const uint* splats_of_entries,
                                         __global const ComponentColors* component_colors,
                                         __global const float* knots, __global uint* entries) {
  __local TileSplat own[GROUP_ITEMS];
  const uint item = get_local_id(0), first = get_group_id(0) * GROUP_ITEMS;
  const uint count = min((uint)GROUP_ITEMS, p.entry_count - first);
  if (item < count) {
    const uint slot = splats_of_entries[first + item];
    const Splat found = splats[slot];
    own[item] = entry_of(p.bin, slot, found, grids[grid_of(found)],
                         (tiles_of_entries[first + item] >> p.bin.has_parts) + p.bin.first_tile,
                         component_colors, knots);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  __local const uint* words = (__local const uint*)own;
  for (uint w = item; w < count * ENTRY_WORDS; w += GROUP_ITEMS)
    entries[(size_t)first * ENTRY_WORDS + w] = words[w];
}
