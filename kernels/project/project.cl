// Particles to splats. A work-item walks one block of particles and writes the visible
// ones one after the other from its own offset, so their order is the file's.

#define PROJECT_PARAMETERS                                                                  \
  __global const float *positions, __global const float *smoothing_lengths,                 \
      __global const float *weights, __global const float *colors,                          \
      __global const float *intensities, __global const float *sort_fields,                 \
      __global const uint *offsets, __global BlockCounts *counts, __global Splat *splats,   \
      __global uint *keys, __global ushort *key_ends, __global uint *order,                 \
      __global const WidthNeeds *width_needs,                                               \
      __global const uint *left_out OWN_COLORS_PARAMETER EXTENDED_PARAMETERS KEY_PARAMETERS \
          TILE_PARAMETERS

#define SPLATS_WRITTEN_AHEAD 64

static inline uint blocks_of(const ProjectParameters p) {
  const uint particles = p.end_particle - p.first_particle;
  return particles / p.block_particles + (particles % p.block_particles != 0);
}

// A call: of a kernel itself PoCL makes three copies, and this is half of what it compiles. The
// lanes' numbers are an argument so that their registers are used (lanes.cl).
__attribute__((noinline)) static void project_block(uint block, const ProjectParameters* of_frame,
                                                    const ExtendedParameters* extended_of_frame,
                                                    INTEGER lane, PROJECT_PARAMETERS) {
  const ProjectParameters p = *of_frame;
  const ExtendedParameters e = *extended_of_frame;
  const Columns columns = columns_of(positions, smoothing_lengths, weights, colors, intensities,
                                     sort_fields OWN_COLORS_ARGUMENT);
  const uint begin = p.first_particle + block * p.block_particles;
  const uint end = min(begin + p.block_particles, p.end_particle);
  const uint numbered = p.first_block + block;
  const uint first_slot = p.first_slot + offsets[numbered];
  uint slot = first_slot, bad_count = 0, too_sharp_count = 0, around_count = 0;
#ifdef COUNT_KEYS
  KeyBins bins;
  bins.least = ~0u;
  bins.most = 0;
#endif
#ifdef COUNT_TILES
  __global uint* count = tile_counts + (size_t)block * p.tile_count;
  for (uint t = 0; t < p.tile_count; ++t)
    count[t] = 0;
  WaitingSplats waiting = no_waiting_splats();
#endif
  if (p.leaves_out_blocks && left_out[block] != 0) {
    counts[numbered].visible = 0;
    counts[numbered].bad = left_out[block] - 1;
    counts[numbered].too_sharp = 0;
    counts[numbered].around = 0;
#ifdef COUNT_KEYS
    key_bins[block] = bins;
#endif
    return;
  }
  for (uint i = begin; i < end; i += LANES) {
    SplatLanes lanes = project_lanes(i, end, p, width_needs, e, columns);
    if (ANY(lanes.bad)) bad_count += count_true(lanes.bad);
#ifdef CLOUDS_AROUND
    if (ANY(lanes.around)) around_count += count_true(lanes.around);
#endif
    const INTEGER unclear = (lanes.visible | lanes.too_sharp) & lanes.unclear;
    if (ANY(unclear)) {
      const INTEGER within = are_within_limits(i, end, unclear, columns, p);
      lanes.visible &= within;
      lanes.too_sharp &= within;
    }
    if (ANY(lanes.too_sharp)) too_sharp_count += count_true(lanes.too_sharp);
    if (!ANY(lanes.visible)) continue;
    SplatArrays found;
#ifdef TILES_OF_LANES
    spread(lanes, select((INTEGER)((int)ONE_TILE), tiles_of_lanes(lanes, p), lanes.visible),
           &found);
#else
    spread(lanes, (INTEGER)(0), &found);
#endif
#ifdef SORT_KEYS
    STORE(AS_WIDE(sort_keys_of(columns, i, end, lanes.sort_field, p)), found.sort_keys);
#endif
    for (uint k = 0; k < LANES; ++k) {
#ifdef WRITES_ALL_LANES
      const uint is_visible = (uint)found.visible[k] & 1u;
#else
      if (!found.visible[k]) continue;
      const uint is_visible = 1;
#endif
#ifdef SORT_KEYS
      const ulong key = (ulong)found.sort_keys[k];
#endif
#ifdef KEY_WINDOW
      if (!is_in_window(key, p)) continue;
#endif
#if defined(OUTPUT_SPLATS) && !defined(EXTENDED_NUMBERS)
      Splat splat = splat_of(&found, k);
#endif
#ifdef EXTENDED_NUMBERS
      Splat splat;
      ExtendedSplat extended;
      if (!extended_splat(i + k, p, e, columns, component_colors, knots, &splat, &extended)) {
        continue;
      }
#endif
#ifdef COPIES
#ifdef EXTENDED_NUMBERS
      const float x = pixels_from_middle(splat.x, splat, p), radius_x = splat.along_x.radius;
      const float y = pixels_from_middle(splat.y, splat, p), radius = splat.radius;
#else
      const float x = found.pixel_x[k], radius_x = found.radius_x[k];
      const float y = found.pixel_y[k], radius = found.radius[k];
#endif
      const Copies copies = copies_in_picture(x, y, radius_x, radius, p);
      for (int copy = copies.first; copy <= copies.last; copy += copies.step) {
#endif
#ifdef OUTPUT_SPLATS
#ifdef COPIES
        Splat listed = splat;
        put_copy(&listed, copy, y, p);
#else
        const Splat listed = splat;
#endif
        __global Splat* kept = splats + slot;
        ask_to_write(kept + SPLATS_WRITTEN_AHEAD);
        STORE_SPLAT(found, k, listed, kept);
#ifdef EXTENDED_NUMBERS
#ifdef COPIES
        extended_splats[slot] = copy_of(copy, extended, pole_of(y, p), e);
#else
        extended_splats[slot] = extended;
#endif
#endif
#endif
#ifdef OUTPUT_KEYS
        keys[slot] = (uint)(key >> 16);
        if (!p.sort_by_field) key_ends[slot] = (ushort)key;
#endif
#ifdef COUNT_KEYS
        const uint bin = bin_of(key, p);
        atomic_inc(&key_counts[bin]);
        bins.least = min(bins.least, bin);
        bins.most = max(bins.most, bin);
#endif
#ifdef COUNT_TILES
        __global const Grid* grid = grids + grid_of(listed);
#ifdef TILES_IN_SPLAT
#ifdef WRITES_ALL_LANES
        if (grid->is_part && !is_visible) continue;
#endif
        const uint touched = tiles_in_lists(listed.tiles, kept, grid);
#else
        const uint touched = tiles_of(listed, *grid);
        tiles[slot] = touched;
#endif
        count_in_tiles(touched, kept, grid, is_visible, count, &waiting);
#endif
        slot += is_visible;
#ifdef COPIES
      }
#endif
    }
  }
#ifdef COUNT_TILES
  count_waiting(&waiting, count);
#endif
  counts[numbered].visible = slot - first_slot;
  counts[numbered].bad = bad_count;
  counts[numbered].too_sharp = too_sharp_count;
  counts[numbered].around = around_count;
#ifdef COUNT_KEYS
  key_bins[block] = bins;
#endif
}

// counts[b] takes the block's numbers of visible and bad particles. With OUTPUT_SPLATS the
// splats are written from offsets[b] on; with OUTPUT_KEYS the upper 32 bits of their sort keys, and
// the 16 bits below them where depths are keys, too; with COUNT_TILES
// tile_counts[b * tile_count + t] takes how many of the block's splats touch tile t, and
// tiles[slot] which they are. With KEY_WINDOW only splats whose sort keys lie in it are there; with
// COUNT_KEYS key_counts[bin] grows by the splats of each bin, and key_bins[b] takes the block's. Of
// a block that no part of the picture shows, left_out[b] is the number of its bad particles and 1
// more, else 0.
__kernel void project(const ProjectParameters p, const ExtendedParameters e, PROJECT_PARAMETERS) {
  const uint block = piece_of_item(blocks_of(p));
  if (block == NO_PIECE) return;
  project_block(block, &p, &e, NUMBERS_OF_LANES, positions, smoothing_lengths, weights, colors,
                intensities, sort_fields, offsets, counts, splats, keys, key_ends, order,
                width_needs,
                left_out OWN_COLORS_ARGUMENT EXTENDED_ARGUMENTS KEY_ARGUMENTS TILE_ARGUMENTS);
}
