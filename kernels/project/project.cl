// Particles to splats. A work-item walks one block of particles and writes the visible
// ones one after the other from its own offset, so their order is the file's.
#include "kernels/common/common.cl"
#include "kernels/project/project.h"
#if DOUBLE_NUMBERS
#include "kernels/project/exact_point.cl"
#endif
#include "kernels/bin/tile_lanes.cl"
#include "kernels/bin/tiles.cl"
#include "kernels/common/grid.h"
#include "kernels/common/lanes.cl"
#include "kernels/common/splat.cl"
#include "kernels/common/splat.h"
#include "kernels/project/depth_key.cl"
#include "kernels/project/load.cl"
#include "kernels/project/splat_arrays.cl"
#include "kernels/project/splat_lanes.cl"
#include "kernels/project/splat_place.cl"
#include "kernels/project/splat_widths.cl"
#include "kernels/project/wide_angle.cl"

#pragma OPENCL FP_CONTRACT OFF

#define SPLATS_WRITTEN_AHEAD 64

static inline uint blocks_of(const ProjectParameters p) {
  const uint particles = p.launch.end_particle - p.launch.first_particle;
  return particles / p.launch.block_particles + (particles % p.launch.block_particles != 0);
}

INLINED KeyBins no_bins(void) {
  KeyBins bins;
  bins.least = ~0u;
  bins.most = 0;
  return bins;
}

INLINED void count_key(uint bin, __global uint* key_counts, KeyBins* bins) {
  atomic_inc(&key_counts[bin]);
  bins->least = min(bins->least, bin);
  bins->most = max(bins->most, bin);
}

// `kept` is where the splat lies; `tiles` takes which it touches, where it does not hold them.
INLINED void list_splat(const Splat listed, __global const Splat* kept, __global const Grid* grid,
                        uint is_visible, const CountedTiles counted, __global uint* tiles,
                        WaitingCounts* waiting) {
  if (WRITES_ALL_LANES && grid->is_part && !is_visible) return;
#if TILES_IN_SPLAT
  const uint touched = tiles_in_lists(listed.tiles, kept, grid);
#else
  const uint touched = tiles_of(listed, *grid);
  *tiles = touched;
#endif
  count_in_tiles(touched, kept, grid, is_visible, counted, waiting);
}

INLINED uint corner_tile_of(const SplatArrays* found, uint k, __global const Grid* grids) {
  return grids[found->grid[k]].corner_tile + (uint)found->from_corner[k];
}

// Writes LANES splats from `slot` on and counts them; returns the slot behind the visible ones.
INLINED uint list_all_lanes(const SplatArrays* found, uint slot, __global Splat* splats,
                            __global const Grid* grids, __global uint* count) {
  for (uint k = 0; k < LANES; ++k) {
    __global Splat* kept = splats + slot;
    ask_to_write(kept + SPLATS_WRITTEN_AHEAD);
    store_splat(found, k, found->splats[k], kept);
    // Vectors' comparisons give -1.
    const uint is_visible = -(uint)found->visible[k];
    count[corner_tile_of(found, k, grids)] += is_visible;
    slot += is_visible;
  }
  // Those of several tiles: which these are no processor foresees, but how many.
  for (uint left = found->have_several; left != 0; left &= left - 1u) {
    const uint k = popcount(~left & (left - 1u));
    count_behind_first((uint)found->tiles[k], (uint)found->tiles_x[k],
                       count + corner_tile_of(found, k, grids));
  }
  return slot;
}

INLINED BlockCounts no_counts(void) {
  BlockCounts counts;
  counts.visible = counts.bad = counts.too_sharp = counts.around = 0;
  return counts;
}

// The splats of LANES particles from i on; false where none is visible. `of_block` counts what is
// no splat.
INLINED int find_splats(uint i, uint end, const ProjectParameters* p,
                        __global const WidthNeeds* width_needs, const SharpParameters* e,
                        const Columns columns, BlockCounts* of_block, SplatArrays* found) {
  SplatLanes lanes = project_lanes(i, end, *p, width_needs, *e, columns);
  if (ANY(lanes.bad)) of_block->bad += count_true(lanes.bad);
  if (CLOUDS_AROUND && ANY(lanes.around)) of_block->around += count_true(lanes.around);
  const INTEGER unclear = (lanes.visible | lanes.too_sharp) & lanes.unclear;
  if (ANY(unclear)) {
    const INTEGER within = are_within_limits(i, end, unclear, columns, *p);
    lanes.visible &= within;
    lanes.too_sharp &= within;
  }
  if (ANY(lanes.too_sharp)) of_block->too_sharp += count_true(lanes.too_sharp);
  if (!ANY(lanes.visible)) return 0;
  TileLanes tiles;
  if (TILES_OF_LANES) tiles = tiles_of_lanes(lanes, *p);
  spread(lanes, tiles.packed, found);
  if (COUNTS_ALL_LANES) {
    found->has_known_tiles = !p->has_parts && !ANY(tiles.packed == (INTEGER)((int)FOUND_AGAIN));
    STORE(lanes.grid, found->grid);
    STORE(tiles.packed, found->tiles);
    STORE(tiles.from_corner, found->from_corner);
    STORE(tiles.tiles_x, found->tiles_x);
    found->have_several = or_of_lanes(tiles.has_several << NUMBERS_OF_LANES);
  }
  if (SORT_KEYS)
    STORE(AS_WIDE(sort_keys_of(columns, i, end, lanes.sort_field, *p)), found->sort_keys);
  return 1;
}

// A call: of a kernel itself PoCL makes three copies, and this is half of what it compiles. The
// lanes' numbers are an argument so that their registers are used (lanes.cl).
__attribute__((noinline)) static void project_block(
    uint block, const ProjectParameters* of_frame, const SharpParameters* sharp_of_frame,
    INTEGER lane, const Columns* of_component, __global const uint* offsets,
    __global const WidthNeeds* width_needs, __global const uint* left_out,
    __global const ComponentColors* component_colors, __global const float* knots,
    __global const Grid* grids, const ProjectTargets* targets) {
  const ProjectParameters p = *of_frame;
  const SharpParameters e = *sharp_of_frame;
  const Columns columns = *of_component;
  const ProjectTargets to = *targets;
  const uint begin = p.launch.first_particle + block * p.launch.block_particles;
  const uint end = min(begin + p.launch.block_particles, p.launch.end_particle);
  const uint first_slot = p.launch.first_slot + offsets[p.launch.first_block + block];
  uint slot = first_slot;
  BlockCounts of_block = no_counts();
  KeyBins bins = no_bins();
  const CountedTiles counted = counted_tiles(to.tile_counts, block, blocks_of(p), p.tile_count);
  if (COUNT_TILES) clear_counts(counted, p.tile_count, p.has_parts);
  WaitingCounts waiting = no_waiting_counts();
  const int is_left_out = p.launch.leaves_out_blocks && left_out[block] != 0;
  if (is_left_out) of_block.bad = left_out[block] - 1;
  for (uint i = begin; i < end && !is_left_out; i += LANES) {
    SplatArrays found;
    if (!find_splats(i, end, &p, width_needs, &e, columns, &of_block, &found)) continue;
    if (COUNTS_ALL_LANES && found.has_known_tiles) {
      slot = list_all_lanes(&found, slot, to.splats, grids, counted.tiles);
      continue;
    }
    for (uint k = 0; k < LANES; ++k) {
      const uint is_visible = (uint)found.visible[k] & 1u;
      if (!WRITES_ALL_LANES && !is_visible) continue;
      const ulong key = SORT_KEYS ? (ulong)found.sort_keys[k] : 0ul;
      if (SORT_KEYS && !is_in_window(key, p)) continue;
      Splat splat;
      if (OUTPUT_SPLATS) splat = splat_of(&found, k, component_colors, knots, p);
      const Copies copies = copies_of(&found, k, p);
      for (int number = copies.first; number <= copies.last; ++number) {
        if (OUTPUT_SPLATS) {
          Splat listed = splat;
          if (COPIES) put_copy(&listed, copy_of_number(number, copies), p);
          __global Splat* kept = to.splats + slot;
          ask_to_write(kept + SPLATS_WRITTEN_AHEAD);
          store_splat(&found, k, listed, kept);
          if (COUNT_TILES) {
            list_splat(listed, kept, grids + grid_of(listed), is_visible, counted, to.tiles + slot,
                       &waiting);
          }
        }
        if (OUTPUT_KEYS) {
          to.keys[slot] = (uint)(key >> 16);
          if (!p.sort_by_field) to.key_ends[slot] = (ushort)key;
        }
        if (COUNT_KEYS) count_key(bin_of(key, p), to.key_counts, &bins);
        slot += is_visible;
      }
    }
  }
  if (COUNT_TILES) count_waiting(&waiting, counted.tiles);
  of_block.visible = slot - first_slot;
  to.counts[p.launch.first_block + block] = of_block;
  if (COUNT_KEYS) to.key_bins[block] = bins;
}

__kernel void project(PROJECT_PARAMETERS) {
  const uint block = piece_of_item(blocks_of(p));
  if (block == NO_PIECE) return;
  const Columns columns = TAKEN_COLUMNS;
  const ProjectTargets targets = {counts,     splats,   keys,        key_ends,
                                  key_counts, key_bins, tile_counts, tiles};
  project_block(block, &p, &e, NUMBERS_OF_LANES, &columns, offsets, width_needs, left_out,
                component_colors, knots, grids, &targets);
}
