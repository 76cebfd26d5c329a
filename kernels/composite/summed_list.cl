// A sum's list, entry by entry. What they are drawn by is worked out for eight at a time; they are
// drawn in the order of the list, so that a crop, whose lists have others that do not show, has the
// bits of the whole picture.
#ifndef LIGHT_ORDERED

#ifdef SPLATS_OF_BLOCK
// Equal splats err by equal roundings, up to half of one each. Drawn by themselves in blocks of so
// many, n of them err by as many roundings and one for each block, not by n. Leaves nothing in the
// block.
static inline void add_block(float* block, float* front) {
  for (int i = 0; i < SUMS * TILE_PIXELS; i += PATCH_WIDTH) {
    store_patch(load_patch(front + i) + load_patch(block + i), front + i);
    store_patch((PATCH)(0.0f), block + i);
  }
}
#endif

#ifdef STENCILS
#define STENCIL_PARAMETER , __global const Stencil* stencil
#define STENCIL_ARGUMENT , stencil
#else
#define STENCIL_PARAMETER
#define STENCIL_ARGUMENT
#endif
#if LANES != 8
#error "kinds of entries are bits of bytes"
#endif

// Bits of LANES entries: those that touch the tile, and of these stencils, narrow splats of at most
// seven pixels along both axes, those and discs of at most sixteen. Lists have some that do not
// touch it, too (splat.h), and those of a crop other ones.
typedef struct EntryKinds {
  uint touching, stencils, narrow, middle;
} EntryKinds;

// Of `count` entries, or of the first LANES of them.
INLINED EntryKinds kinds_of(__global const TileSplat* entries, uint count,
                            const EntryWindows* windows, const INTEGER narrow STENCIL_PARAMETER) {
  const INTEGER bits = (INTEGER)(1, 2, 4, 8, 16, 32, 64, 128);
  const INTEGER is_there = NUMBERS_OF_LANES < (INTEGER)((int)min(count, (uint)LANES));
  INTEGER touches =
      (load_eight_integers(windows->first_row) <= load_eight_integers(windows->last_row)) &
      (load_eight_integers(windows->first_column) <= load_eight_integers(windows->last_column));
  INTEGER kinds = bits;
#ifdef NARROW_SPLATS
  kinds |= (bits << 8) & (narrow > (INTEGER)(0)) & (narrow <= (INTEGER)(SEVEN));
  kinds |= (bits << 16) & (narrow > (INTEGER)(SEVEN));
#endif
#ifdef NARROW_DISCS
  kinds |= (bits << 16) & (narrow > (INTEGER)(0));
#endif
#ifdef STENCILS
  // Stencils beside the tile add nothing to it.
  const INTEGER is_stencil = (OF_ENTRIES(entries, sigma) < 0.0f) & (INTEGER)(stencil ? -1 : 0);
  kinds |= (bits << 24) & is_stencil;
  touches |= is_stencil;
#endif
  const uint all = or_of_lanes(kinds & touches & is_there);
  EntryKinds found;
  found.touching = all & 0xffu;
  found.narrow = all >> 8 & 0xffu;
  found.middle = all >> 16 & 0xffu;
  found.stencils = all >> 24;
  return found;
}

// What eight entries of a list are drawn by.
typedef struct EntryBatch {
  EntryWindows windows;
#ifdef NARROW_SPLATS
  NarrowSplats narrow;
#endif
#ifdef NARROW_DISCS
  NarrowDiscs discs;
#endif
#ifdef STENCILS
  StencilBatch stencils;
#endif
} EntryBatch;

// Finds it, of `count` entries or the first LANES of them.
INLINED EntryKinds find_batch(__global const TileSplat* entries, uint count, float mean_sigma,
                              EntryBatch* batch STENCIL_PARAMETER) {
  find_windows(entries, &batch->windows);
  INTEGER narrow = (INTEGER)(0);
#ifdef NARROW_SPLATS
  find_narrow_splats(entries, mean_sigma, &batch->windows, &batch->narrow);
  narrow = load_eight_integers(batch->narrow.pixels);
#endif
#ifdef NARROW_DISCS
  find_narrow_discs(entries, &batch->windows, &batch->discs);
  narrow = load_eight_integers(batch->discs.columns);
#endif
  const EntryKinds kinds = kinds_of(entries, count, &batch->windows, narrow STENCIL_ARGUMENT);
#ifdef STENCILS
  if (kinds.stencils != 0) find_stencils(entries, stencil, &batch->stencils);
#endif
  return kinds;
}

// Draws entry `i` of a batch.
INLINED void draw_summed(float* tile, WaitingSplats* waiting, __global const TileSplat* entry,
                         int i, EntryBatch* batch, const EntryKinds kinds, const SplatTile* of_tile,
                         float mean_sigma STENCIL_PARAMETER) {
#ifdef NARROW_SPLATS
  if (kinds.narrow >> i & 1u) {
    add_narrow_splat(tile, &batch->narrow, i, entry);
    return;
  }
#ifdef MIDDLE_SPLATS
  if (kinds.middle >> i & 1u) {
    add_middle_splat(tile, &batch->narrow, i, entry);
    return;
  }
#endif
#endif
#ifdef NARROW_DISCS
  if (kinds.middle >> i & 1u) {
    add_narrow_disc(tile, &batch->discs, i, entry);
    return;
  }
#endif
#ifdef STENCILS
  if (kinds.stencils >> i & 1u) {
    add_stencil(tile, &batch->stencils, i, entry, stencil);
    return;
  }
#endif
  const int2 rows = rows_of_entry(&batch->windows, i);
  const int2 columns = columns_of_entry(&batch->windows, i);
  if (!let_wait(tile, waiting, rows, columns, entry, mean_sigma, 0))
    add_splat(tile, entry, rows, columns, of_tile, 0);
}

#ifdef STENCILS
// Draws LANES entries, if all of them are stencils, as most are on blurred grids; returns whether
// they are.
INLINED int draw_stencils(float* tile, __global const TileSplat* entries,
                          __global const Stencil* stencil, StencilBatch* batch) {
  if (!stencil || !are_all_stencils(entries)) return 0;
  find_stencils(entries, stencil, batch);
  for (int i = 0; i < LANES; ++i)
    add_stencil(tile, batch, i, entries + i, stencil);
  return 1;
}
#endif

INLINED void draw_list(float* tile, const Segment segment, const TileInPlanes* place,
                       __global const Grid* grid, uint grid_number,
                       __global const TileSplat* entries, __global float* partials,
                       const CompositeParameters* p CLOUDS_PARAMETERS STENCIL_PARAMETERS) {
  const SplatTile of_tile = splat_tile(*grid, segment.tile, p);
  const float mean_sigma = grid->mean_sigma;
#ifdef SPLATS_OF_BLOCK
  float front[PLANES * TILE_PIXELS];
  clear_planes(front);
  uint drawn = 0;
#endif
  EntryBatch batch;
#ifdef STENCILS
  __global const Stencil* const stencil = stencil_of_grid(stencils, grid_number);
  clear_stencils(&batch.stencils);
#endif
  WaitingSplats waiting;
  clear_waiting(&waiting);
  RowsAhead rows = rows_ahead(segment, place);
  for (uint k = segment.begin; k < segment.end; k += LANES) {
    __global const TileSplat* first = entries + k;
    ask_for_entries(first + ENTRIES_AHEAD);
    ask_for_rows(&rows, place, LANES);
#if defined(STENCILS) && !defined(SPLATS_OF_BLOCK)
    if (segment.end - k >= LANES && draw_stencils(tile, first, stencil, &batch.stencils)) continue;
#endif
    const EntryKinds kinds =
        find_batch(first, segment.end - k, mean_sigma, &batch STENCIL_ARGUMENT);
    for (uint left = kinds.touching; left != 0; left &= left - 1u) {
      const int i = (int)popcount(~left & (left - 1u));
      draw_summed(tile, &waiting, first + i, i, &batch, kinds, &of_tile,
                  mean_sigma STENCIL_ARGUMENT);
#ifdef SPLATS_OF_BLOCK
      if (++drawn % SPLATS_OF_BLOCK == 0u) {
        add_waiting(tile, &waiting);
        add_block(tile, front);
      }
#endif
    }
  }
  add_waiting(tile, &waiting);
#ifdef SPLATS_OF_BLOCK
  add_block(tile, front);
  store_segment(front, segment, place, partials);
#else
  store_segment(tile, segment, place, partials);
#endif
}
#endif
