// Splats to lists per tile, in order: count, scan, scatter. A work-item walks one block of
// splats; block and tile fix where each entry goes, so lists keep the splats' order and
// never depend on timing.

static inline uint slots_end(const BinParameters p, __global const BlockCounts* blocks,
                             uint block) {
  const uint begin = p.first + block * p.stride;
#ifdef BLOCKS_OF_PROJECTION
  // Blocks are the projection's: each fills only a part of its stride.
  return min(begin + p.length, block * p.stride + blocks[block].visible);
#else
  return min(begin + p.length, p.end);
#endif
}

// Splats in sorted order, and in each list the entries that follow.
#define SPLATS_AHEAD 16
#define ENTRIES_AHEAD 2

#ifndef BLOCKS_OF_PROJECTION
// counts[block * tile_count + tile]. Splats in sorted order lie all over memory: they are
// fetched once, here, and kept in order for the scatter.
__kernel void bin_count(const BinParameters p, __global const Grid* grids,
                        __global const Splat* splats, __global const uint* order,
                        __global uint* counts, __global uint* tiles, __global Splat* in_order) {
  const uint block = get_global_id(0);
  __global uint* count = counts + (size_t)block * p.tile_count;
  for (uint t = 0; t < p.tile_count; ++t)
    count[t] = 0;
  WaitingSplats waiting = no_waiting_splats();
  const uint begin = p.first + block * p.stride;
  const uint end = min(begin + p.length, p.end);
  for (uint slot = begin; slot < end; ++slot) {
    ask_for(splats + order[min(slot + SPLATS_AHEAD, end - 1)]);
    const Splat splat = splats[order[slot]];
    in_order[slot - p.first] = splat;
    __global const Grid* grid = grids + grid_of(splat);
#ifdef TILES_IN_SPLAT
    const uint touched = tiles_with_memory(splat.tiles, splat, *grid);
#else
    const uint touched = tiles_of(splat, *grid);
#endif
    tiles[slot - p.first] = touched;
    count_in_tiles(touched, splat, grid, count, &waiting);
  }
  count_waiting(&waiting, count);
}
#endif

// Per tile, an exclusive scan over the blocks, in place, and the list's length.
__kernel void bin_scan_blocks(const BinParameters p, __global uint* counts,
                              __global uint* lengths) {
  const uint tile = get_global_id(0);
  if (tile >= p.tile_count) return;
  uint running = 0;
  for (uint b = 0; b < p.block_count; ++b) {
    const size_t place = (size_t)b * p.tile_count + tile;
    const uint count = counts[place];
    counts[place] = running;
    running += count;
  }
  lengths[tile] = running;
}

// Starts of the lists of a band of tiles, and the segments that long ones are cut into.
__kernel void bin_scan_tiles(const BinParameters p, __global const uint* lengths,
                             __global uint* starts, __global Segment* segments) {
  if (get_global_id(0) != 0) return;
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

__kernel void bin_scatter(const BinParameters p, __global const Grid* grids,
                          __global const Splat* splats, __global const uint* order,
                          __global const BlockCounts* blocks, __global uint* counts,
                          __global const uint* tiles, __global const Splat* in_order,
                          __global const uint* starts,
                          __global const ComponentColors* component_colors,
                          __global const float* knots, __global TileSplat* entries) {
  const uint block = get_global_id(0);
  __global uint* count = counts + (size_t)block * p.tile_count;
  const uint end = slots_end(p, blocks, block);
  for (uint slot = p.first + block * p.stride; slot < end; ++slot) {
#ifdef BLOCKS_OF_PROJECTION
    const Splat splat = splats[slot];
#else
    const Splat splat = in_order[slot - p.first];
#endif
    const Grid grid = grids[grid_of(splat)];
#if defined(BLOCKS_OF_PROJECTION) && defined(TILES_IN_SPLAT)
    const uint touched = tiles_with_memory(splat.tiles, splat, grid);
#else
    const uint touched = tiles[slot - p.first];
#endif
    const int4 range = unpack_tiles(touched, splat, grid);
#ifdef EXTENDED_NUMBERS
    TileSplat entry;
#ifdef LIGHT_ORDERED
    entry.slot = order[slot];
#else
    entry.slot = slot;
#endif
#else
    const int bits = place_bits_of(splat, grid);
    const float unit = unit_of(splat, grid);
    TileSplat entry = entry_without_place(splat, component_colors[component_of(splat)], knots, p);
#endif
    // One loop: most splats are in one tile, and it ends where a processor expects it to.
    int tx = range.x, ty = range.z;
    for (int left = (range.y - range.x + 1) * (range.w - range.z + 1); left > 0; --left) {
      const uint tile = grid.corner_tile + (uint)(ty * grid.tiles_x + tx);
      // Of the band that lists are made of.
      if (tile - p.first_tile < p.end_tile - p.first_tile) {
#ifndef EXTENDED_NUMBERS
        set_place(&entry, splat, grid, tx * TILE_WIDTH + TILE_WIDTH / 2,
                  ty * TILE_HEIGHT + TILE_HEIGHT / 2, bits, unit);
#endif
        __global TileSplat* to = entries + (size_t)starts[tile] + count[tile]++;
        *to = entry;
        ask_to_write(to + ENTRIES_AHEAD);
      }
      const int is_last = tx == range.y;
      tx = is_last ? range.x : tx + 1;
      ty += is_last;
    }
  }
}
