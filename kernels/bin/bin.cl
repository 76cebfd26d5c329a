// Splats to lists per tile, in order: count, scan, scatter. A work-item walks one block of
// splats; block and tile fix where each entry goes, so lists keep the splats' order and
// never depend on timing.
#include "kernels/bin/bin.h"
#include "kernels/bin/entries.cl"
#include "kernels/bin/tiles.cl"
#include "kernels/common/common.cl"
#include "kernels/common/grid.h"
#include "kernels/common/splat.cl"
#include "kernels/common/splat.h"
#include "kernels/project/project.h"

static inline uint slots_end(const BinParameters p, __global const BlockCounts* blocks,
                             uint block) {
  const uint begin = p.first + block * p.stride;
#if !LIGHT_ORDERED
  // Blocks are the projection's: each fills only a part of its stride.
  return min(begin + p.length, block * p.stride + blocks[block].visible);
#else
  return min(begin + p.length, p.end);
#endif
}

// Splats in sorted order, and in each list the entries that follow.
#define SPLATS_AHEAD 32
#define ENTRIES_AHEAD 4
#define SLOTS_AHEAD 32

#if LIGHT_ORDERED
KERNEL_BODY void count_block(const BinParameters* of_band, __global const Grid* grids,
                             __global const Splat* splats, __global const uint* order,
                             __global uint* counts, __global uint* tiles, __global Splat* in_order,
                             uint block) {
  const BinParameters p = *of_band;
  const CountedTiles counted = counted_tiles(counts, block, p.block_count, p.tile_count);
  clear_counts(counted, p.tile_count, p.has_parts);
  WaitingCounts waiting = no_waiting_counts();
  const uint begin = p.first + block * p.stride;
  const uint end = min(begin + p.length, p.end);
  for (uint slot = begin; slot < end; ++slot) {
    ask_for(order + slot + NUMBERS_AHEAD);
    ask_for(splats + order[min(slot + SPLATS_AHEAD, end - 1)]);
    const Splat splat = splats[order[slot]];
    __global Splat* kept = in_order + (slot - p.first);
    ask_to_write(kept + SLOTS_AHEAD);
    *kept = splat;
    __global const Grid* grid = grids + grid_of(splat);
#if TILES_IN_SPLAT
    const uint touched = tiles_in_lists(splat.tiles, kept, grid);
#else
    const uint touched = tiles_of(splat, *grid);
#endif
    tiles[slot - p.first] = touched;
    count_in_tiles(touched, kept, grid, 1, counted, &waiting);
  }
  count_waiting(&waiting, counted.tiles);
}

// counts[block * tile_count + tile], and behind those of all blocks the same of what comes behind
// all others, where there may be any. Splats in sorted order lie all over memory: they are
// fetched once, here, and kept in order for the scatter.
__kernel void bin_count(const BinParameters p, __global const Grid* grids,
                        __global const Splat* splats, __global const uint* order,
                        __global uint* counts, __global uint* tiles, __global Splat* in_order) {
  count_block(&p, grids, splats, order, counts, tiles, in_order, (uint)get_global_id(0));
}
#endif

// Scans the counts of the tiles from `first` on.
KERNEL_BODY void scan_blocks_of_tiles(uint tile_count, uint block_count, __global uint* counts,
                                      __global uint* lengths, uint first) {
  if (first >= tile_count) return;
  if (tile_count - first >= TILES_OF_SCAN) {
    uint8 running = (uint8)(0u);
    for (uint b = 0; b < block_count; ++b) {
      __global uint* of_block = counts + (size_t)b * tile_count + first;
      const uint8 count = vload8(0, of_block);
      vstore8(running, 0, of_block);
      running += count;
    }
    vstore8(running, 0, lengths + first);
    return;
  }
  for (uint tile = first; tile < tile_count; ++tile) {
    uint running = 0;
    for (uint b = 0; b < block_count; ++b) {
      const size_t place = (size_t)b * tile_count + tile;
      const uint count = counts[place];
      counts[place] = running;
      running += count;
    }
    lengths[tile] = running;
  }
}

// Per tile, an exclusive scan over the blocks, in place, and the list's length. A work-item takes
// as many tiles as a vector holds: what they count lies side by side.
__kernel void bin_scan_blocks(const BinParameters p, __global uint* counts,
                              __global uint* lengths) {
  scan_blocks_of_tiles(p.tile_count, (1u + p.has_parts) * p.block_count, counts, lengths,
                       get_global_id(0) * TILES_OF_SCAN);
}

KERNEL_BODY void scan_tiles(const BinParameters* of_band, __global const uint* lengths,
                            __global uint* starts, __global Segment* segments) {
  const BinParameters p = *of_band;
  uint running = 0, segment_count = 0, partial_count = 0;
  for (uint t = p.first_tile; t < p.end_tile; ++t) {
    const uint length = lengths[t];
    starts[t] = running;
    const uint pieces = length / p.segment_length + (length % p.segment_length != 0);
    for (uint k = 0; k < pieces && segment_count < p.segment_capacity; ++k) {
      Segment segment;
      segment.tile = t;
      segment.begin = running + k * p.segment_length;
      segment.end = running + min((k + 1) * p.segment_length, length);
      segment.partial = pieces > 1 ? partial_count++ : NO_PARTIAL;
      segments[segment_count++] = segment;
    }
    running += length;
  }
}

// Starts of the lists of a band of tiles, and the segments that long ones are cut into.
__kernel void bin_scan_tiles(const BinParameters p, __global const uint* lengths,
                             __global uint* starts, __global Segment* segments) {
  if (get_global_id(0) == 0) scan_tiles(&p, lengths, starts, segments);
}

// Where entries of a band's lists go.
typedef struct ListedBand {
  uint first_tile, tiles;
  __global const uint* starts;
  CountedTiles counted;  // of the block's entries in each tile so far
  __global TileSplat* entries;
} ListedBand;

INLINED int is_of_band(const ListedBand band, uint tile) {
  return tile - band.first_tile < band.tiles;
}

// The place for the next entry of a tile of the band.
INLINED __global TileSplat* next_entry(const ListedBand band, uint tile) {
  return band.entries + (band.starts[tile] + band.counted.tiles[tile]++);
}
INLINED __global TileSplat* next_listed(const ListedBand band, int is_behind, uint tile) {
  __global uint* count = is_behind ? band.counted.behind : band.counted.tiles;
  return band.entries + (band.starts[tile] + count[tile]++);
}

// A call: hardly any splats have to have their tiles found again.
__attribute__((noinline)) static void list_far_or_wide(
    const BinParameters* p, const ListedBand* band, __global const Grid* grids,
    __global const Splat* from, uint slot, __global const ComponentColors* component_colors,
    __global const float* knots) {
  const Splat splat = *from;
  const Grid grid = grids[grid_of(splat)];
  const ListedTiles listed = find_lists(splat, grid);
  const int4 range = listed.range;
  TileSplat entry =
      entry_without_place(splat, slot, component_colors[component_of(splat)], knots, *p);
  for (int ty = range.z; ty <= range.w; ++ty) {
    for (int tx = range.x; tx <= range.y; ++tx) {
      const uint tile = grid.corner_tile + (uint)(ty * grid.tiles_x + tx);
      if (!is_of_band(*band, tile)) continue;
      set_place(&entry, splat, grid,
                (int2)(tx * TILE_WIDTH + TILE_WIDTH / 2, ty * TILE_HEIGHT + TILE_HEIGHT / 2));
      *next_listed(*band, listed.is_behind, tile) = entry;
    }
  }
}

// In units of 2^-bits pixels. TILE_WIDTH and TILE_HEIGHT are powers of two.
INLINED int2 size_of_tile(int bits) {
  return (int2)(TILE_WIDTH, TILE_HEIGHT) << bits;
}

INLINED void list_splat(const BinParameters* p, const ListedBand* band, __global const Grid* grids,
                        __global const Splat* from, uint slot, uint touched,
                        __global const ComponentColors* component_colors,
                        __global const float* knots) {
  const Splat splat = *from;
  const int bits = p->place_bits;
  const float unit = as_float((127 - bits) << 23);
  TileSplat entry =
      entry_without_place(splat, slot, component_colors[component_of(splat)], knots, *p);
  __global const Grid* grid = grids + grid_of(splat);
  const uint column = first_column_of_tiles(touched), row = first_row_of_tiles(touched);
  const uint columns = columns_of_tiles(touched), tiles_x = (uint)grid->tiles_x;
  // From the middle of the first tile, and between those of two.
  const int2 to_middle =
      (int2)(grid->middle_x, grid->middle_y) - (int2)(TILE_WIDTH / 2, TILE_HEIGHT / 2);
  int2 units = (int2)(splat.x, splat.y) + (to_middle << bits) -
               (int2)((int)column, (int)row) * size_of_tile(bits);
  uint tile = grid->corner_tile + row * tiles_x + column, in_row = 0;
  // One loop: most splats are in one tile, and it ends where a processor expects it to.
  for (uint left = columns * rows_of_tiles(touched);;) {
    if (is_of_band(*band, tile)) {
      __global TileSplat* to = next_entry(*band, tile);
      set_units(&entry, splat, units, unit);
      *to = entry;
      ask_to_write(to + ENTRIES_AHEAD);
    }
    if (--left == 0) return;
    ++in_row;
    const int is_last = in_row == columns;
    const int back = is_last ? (int)columns : 0;
    tile += is_last ? tiles_x - columns + 1 : 1;
    in_row -= (uint)back;
    units -= (int2)((1 - back) * TILE_WIDTH, is_last ? TILE_HEIGHT : 0) << bits;
  }
}

KERNEL_BODY void scatter_block(const BinParameters* of_band, __global const Grid* grids,
                               __global const Splat* splats, __global const uint* order,
                               __global const BlockCounts* blocks, __global uint* counts,
                               __global const uint* tiles, __global const Splat* in_order,
                               __global const uint* starts,
                               __global const ComponentColors* component_colors,
                               __global const float* knots, __global TileSplat* entries,
                               uint block) {
  const BinParameters p = *of_band;
  const uint end = slots_end(p, blocks, block);
  ListedBand band;
  band.first_tile = p.first_tile;
  band.tiles = p.end_tile - p.first_tile;
  band.starts = starts;
  band.counted = counted_tiles(counts, block, p.block_count, p.tile_count);
  band.entries = entries;
  for (uint slot = p.first + block * p.stride; slot < end; ++slot) {
#if !LIGHT_ORDERED
    __global const Splat* from = splats + slot;
#else
    __global const Splat* from = in_order + (slot - p.first);
#endif
    ask_for(from + SLOTS_AHEAD);
#if !LIGHT_ORDERED && TILES_IN_SPLAT
    const uint touched = tiles_in_lists(from->tiles, from, grids + grid_of(*from));
#else
    const uint touched = tiles[slot - p.first];
#endif
    const uint own_slot = LIGHT_ORDERED ? order[slot] : slot;
    if (touched == FOUND_AGAIN) {
      list_far_or_wide(&p, &band, grids, from, own_slot, component_colors, knots);
    } else {
      list_splat(&p, &band, grids, from, own_slot, touched, component_colors, knots);
    }
  }
}

__kernel void bin_scatter(const BinParameters p, __global const Grid* grids,
                          __global const Splat* splats, __global const uint* order,
                          __global const BlockCounts* blocks, __global uint* counts,
                          __global const uint* tiles, __global const Splat* in_order,
                          __global const uint* starts,
                          __global const ComponentColors* component_colors,
                          __global const float* knots, __global TileSplat* entries) {
  const uint block = piece_of_item(p.block_count);
  if (block == NO_PIECE) return;
  scatter_block(&p, grids, splats, order, blocks, counts, tiles, in_order, starts, component_colors,
                knots, entries, block);
}
