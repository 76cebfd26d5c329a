// A sum's list, eight entries at a time and those of one kind after the other: what comes first
// does not matter, and a processor foresees what it does next.
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

// Kinds of entries, of each of which there is a bit for each of LANES in a byte of a word.
#define NARROW 0  // at most seven pixels along both axes
#define MIDDLE 1  // at most sixteen
#define STENCIL 2
#define OTHER 3

INLINED uint entries_of(uint kinds, int kind) {
  return kinds >> 8 * kind & 0xffu;
}

// Of `count` entries, or of the first LANES of them, those that touch the tile: lists have some
// that do not, too (splat.h), and those of a crop other ones.
INLINED uint kinds_of(__global const TileSplat* entries, uint count, const EntryWindows* windows,
                      const INTEGER narrow STENCIL_PARAMETER) {
  const INTEGER bits = (INTEGER)(1, 2, 4, 8, 16, 32, 64, 128);
  const INTEGER is_there = NUMBERS_OF_LANES < (INTEGER)((int)min(count, (uint)LANES));
  const INTEGER touches = (vload8(0, windows->first_row) <= vload8(0, windows->last_row)) &
                          (vload8(0, windows->first_column) <= vload8(0, windows->last_column));
  INTEGER kinds = bits << 8 * OTHER;
#ifdef NARROW_SPLATS
  kinds = select(kinds, bits << 8 * MIDDLE, narrow > (INTEGER)(0));
  kinds = select(kinds, bits << 8 * NARROW, narrow > (INTEGER)(0) & narrow <= (INTEGER)(SEVEN));
#endif
#ifdef STENCILS
  if (stencil) kinds = select(kinds, bits << 8 * STENCIL, OF_ENTRIES(entries, sigma) < 0.0f);
#endif
  return or_of_lanes(kinds & touches & is_there);
}

// What eight entries of a list are drawn by.
typedef struct EntryBatch {
  EntryWindows windows;
#ifdef NARROW_SPLATS
  NarrowSplats narrow;
#endif
#ifdef STENCILS
  StencilBatch stencils;
#endif
} EntryBatch;

// Finds it, of `count` entries or the first LANES of them. Returns their kinds.
INLINED uint find_batch(__global const TileSplat* entries, uint count, float mean_sigma,
                        EntryBatch* batch STENCIL_PARAMETER) {
#ifdef STENCILS
  if (stencil && count >= LANES && are_all_stencils(entries)) {
    find_stencils(entries, stencil, &batch->stencils);
    return 0xffu << 8 * STENCIL;
  }
#endif
  find_windows(entries, &batch->windows);
  INTEGER narrow = (INTEGER)(0);
#ifdef NARROW_SPLATS
  find_narrow_splats(entries, mean_sigma, &batch->windows, &batch->narrow);
  narrow = vload8(0, batch->narrow.pixels);
#endif
  const uint kinds = kinds_of(entries, count, &batch->windows, narrow STENCIL_ARGUMENT);
#ifdef STENCILS
  if (entries_of(kinds, STENCIL) != 0) find_stencils(entries, stencil, &batch->stencils);
#endif
  return kinds;
}

// The number of the first of some entries.
INLINED int first_entry(uint entries) {
  return (int)popcount(~entries & (entries - 1u));
}

#define EACH_ENTRY(of_kind, DRAW)                             \
  for (uint left = (of_kind); left != 0; left &= left - 1u) { \
    const int i = first_entry(left);                          \
    DRAW;                                                     \
  }

INLINED void draw_other(float* tile, WaitingSplats* waiting, __global const TileSplat* entry,
                        const EntryWindows* windows, int i, const SplatTile* of_tile,
                        float mean_sigma) {
  const int2 rows = rows_of_entry(windows, i), columns = columns_of_entry(windows, i);
  if (!let_wait(tile, waiting, rows, columns, entry, mean_sigma, 0))
    add_splat(tile, entry, rows, columns, of_tile, 0);
}

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
    const uint kinds = find_batch(first, segment.end - k, mean_sigma, &batch STENCIL_ARGUMENT);
#ifdef STENCILS
    EACH_ENTRY(entries_of(kinds, STENCIL),
               add_stencil(tile, &batch.stencils, i, first + i, stencil))
#endif
#ifdef NARROW_SPLATS
    EACH_ENTRY(entries_of(kinds, NARROW), add_narrow_splat(tile, &batch.narrow, i, first + i))
#ifdef MIDDLE_SPLATS
    EACH_ENTRY(entries_of(kinds, MIDDLE), add_middle_splat(tile, &batch.narrow, i, first + i))
#endif
#endif
    EACH_ENTRY(entries_of(kinds, OTHER),
               draw_other(tile, &waiting, first + i, &batch.windows, i, &of_tile, mean_sigma))
#ifdef SPLATS_OF_BLOCK
    drawn += popcount(kinds);
    if (drawn + LANES > SPLATS_OF_BLOCK) {
      add_waiting(tile, &waiting);
      add_block(tile, front);
      drawn = 0;
    }
#endif
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
