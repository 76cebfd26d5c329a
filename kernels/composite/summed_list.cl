// A sum's list: its entries group by group, those of a group kind by kind, since a
// processor foresees the branches of each kind's loop, but not which kind comes next.
#include "kernels/bin/bin.h"
#include "kernels/bin/entry_lanes.cl"
#include "kernels/common/common.cl"
#include "kernels/common/grid.h"
#include "kernels/common/lanes.cl"
#include "kernels/composite/clouds.cl"
#include "kernels/composite/composite.h"
#include "kernels/composite/entry_windows.cl"
#include "kernels/composite/narrow_splats.cl"
#include "kernels/composite/patch.cl"
#include "kernels/composite/rows.cl"
#include "kernels/composite/stencil.cl"
#include "kernels/composite/stencil_rows.cl"
#include "kernels/composite/tile_planes.cl"
#include "kernels/composite/waiting.cl"
#if FACE_OF_CUBE
#include "kernels/composite/face_rows.cl"
#else
#include "kernels/composite/splat_rows.cl"
#endif

#if !LIGHT_ORDERED

// Entries of a sum's list, gathered into groups of so many that touch the tile. Which these are is
// the same for a crop, whose lists have others that do not touch it (splat.h): so it has the bits
// of the whole picture, in whatever order those of a group are drawn.

// Kinds of entries are bits of bytes, and of a word.
REQUIRE(kinds_in_bits, LANES == 8 && ENTRIES_OF_GROUP == 64);

// What entries are drawn by. Numbers of four bytes alone, ROOM_OF_ENTRIES of each.
typedef struct EntryGroup {
  int entry[ROOM_OF_ENTRIES];
  EntryWindows windows;
#ifdef NARROW_SPLATS
  NarrowSplats narrow;
#endif
} EntryGroup;

// How many there are, and a bit for each narrow one, kind by kind.
typedef struct GroupKinds {
  uint count;
  ulong smallest, small, middle;
} GroupKinds;

static inline void clear_kinds(GroupKinds* kinds) {
  kinds->count = 0;
  kinds->smallest = kinds->small = kinds->middle = 0;
}

// Bits of LANES entries, kind by kind in the bytes of a word: those that touch the tile, and as
// GroupKinds has them.
#define TOUCHING(found) ((found)&0xffu)
#define BITS_OF_LANES ((INTEGER)(1, 2, 4, 8, 16, 32, 64, 128))

// Bits of those of LANES entries that there are.
INLINED INTEGER bits_of_list(uint count) {
  return BITS_OF_LANES & (NUMBERS_OF_LANES < (INTEGER)((int)min(count, (uint)LANES)));
}

INLINED uint kinds_of(uint count, uint at, const EntryWindows* windows, const INTEGER narrow) {
  const INTEGER touches = (load_eight_integers(windows->first_row + at) <=
                           load_eight_integers(windows->last_row + at)) &
                          (load_eight_integers(windows->first_column + at) <=
                           load_eight_integers(windows->last_column + at));
  INTEGER kinds = bits_of_list(count) & touches;
#ifdef NARROW_SPLATS
  const INTEGER bits = BITS_OF_LANES;
  kinds |= (bits << 8) & (narrow == (INTEGER)(SMALLEST));
  kinds |= (bits << 16) & (narrow == (INTEGER)(SMALL));
  kinds |= (bits << 24) & (narrow > (INTEGER)(SMALL));
#endif
  return or_of_lanes(kinds);
}

// Finds what LANES entries of a list, or `count` if there are fewer, are drawn by, and leaves it
// behind `at` others.
INLINED uint find_entries(const EntryLanes lanes, __global const TileSplat* list, uint first,
                          uint count, uint at, float mean_sigma, EntryGroup* group) {
  INTEGER narrow = (INTEGER)(0);
  STORE((INTEGER)((int)first) + NUMBERS_OF_LANES, group->entry + at);
  find_windows(lanes, list + first, at, &group->windows);
#ifdef NARROW_SPLATS
  narrow = find_narrow_splats(lanes, at, mean_sigma, &group->windows, &group->narrow);
#endif
  return kinds_of(count, at, &group->windows, narrow);
}

// Counts kinds of those entries of kinds_of() that are bits of `lanes`, the first as number `at`.
INLINED void count_kinds(GroupKinds* kinds, uint found, uint lanes, uint at) {
  kinds->smallest |= (ulong)(found >> 8 & lanes) << at;
  kinds->small |= (ulong)(found >> 16 & lanes) << at;
  kinds->middle |= (ulong)(found >> 24 & lanes) << at;
}

INLINED void move_entry(EntryGroup* group, uint from, uint to) {
  uint* numbers = (uint*)group;
  for (uint k = 0; k < sizeof(EntryGroup) / sizeof(uint); k += ROOM_OF_ENTRIES)
    numbers[k + to] = numbers[k + from];
}

typedef struct SummedList {
  float* tile;
  __global const TileSplat* entries;
  SplatTile of_tile;
  float mean_sigma;
  WaitingSplats waiting;
  EntryGroup group;
  GroupKinds kinds;
#if STENCILS
  __global const Stencil* stencil;
  StencilBatch stencils;
#endif
#ifdef SPLATS_OF_BLOCK
  float* front;
  uint drawn;  // in the tile, which is the block
#endif
} SummedList;

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

// Before so many more are drawn.
INLINED void make_room_in_block(SummedList* list, uint count) {
  if (list->drawn + count > SPLATS_OF_BLOCK) {
    add_waiting(list->tile, &list->waiting);
    add_block(list->tile, list->front);
    list->drawn = 0;
  }
  list->drawn += count;
}
#else
#define make_room_in_block(list, count)
#endif

// Draws an entry of the group that is no narrow one.
INLINED void draw_other(SummedList* list, int i, __global const TileSplat* entry) {
  const int2 rows = rows_of_entry(&list->group.windows, i);
  const int2 columns = columns_of_entry(&list->group.windows, i);
  if (let_wait_if_it_does(list->tile, &list->waiting, rows, columns, entry, list->mean_sigma, 0))
    return;
  add_splat(list->tile, entry, rows, columns, &list->of_tile, 0);
}

#define EACH_ENTRY(chosen, DRAW)                                             \
  for (ulong left = (chosen); left != 0; left &= left - 1ul) {               \
    const int i = (int)popcount(~left & (left - 1ul));                       \
    __global const TileSplat* const entry = list->entries + group->entry[i]; \
    DRAW                                                                     \
  }

// Draws the group and leaves none in it. A call whose last argument tells the compiler that it may
// use registers of sixteen floats (lanes.cl).
__attribute__((noinline)) static void draw_group(SummedList* list, PATCH lanes) {
  const EntryGroup* const group = &list->group;
  const GroupKinds kinds = list->kinds;
  float* const tile = list->tile;
  make_room_in_block(list, kinds.count);
#ifdef NARROW_SPLATS
  EACH_ENTRY(kinds.smallest, add_grain(tile, &group->narrow, i, entry);)
  EACH_ENTRY(kinds.small, add_seven(tile, &group->narrow, i, entry);)
#if MIDDLE_SPLATS
  EACH_ENTRY(kinds.middle, add_middle_splat(tile, &group->narrow, i, entry);)
#endif
#endif
  const ulong all = ~0ul >> (ENTRIES_OF_GROUP - kinds.count);
  EACH_ENTRY(all & ~(kinds.smallest | kinds.small | kinds.middle), draw_other(list, i, entry);)
  clear_kinds(&list->kinds);
}

#if STENCILS
INLINED void draw_stencil(SummedList* list, uint first, int i) {
  make_room_in_block(list, 1u);
  add_stencil(list->tile, &list->stencils, i, list->entries + first + i, list->stencil);
}

// Finds those of LANES entries that are stencils, and returns their bits. Beside the tile they add
// nothing to it.
INLINED uint find_some_stencils(SummedList* list, const EntryLanes lanes, uint count) {
  if (!list->stencil) return 0;
  const INTEGER are_stencils = lanes.sigma < 0.0f;
  if (!ANY(are_stencils)) return 0;
  find_stencils(lanes, list->stencil, &list->stencils);
  return or_of_lanes(bits_of_list(count) & are_stencils);
}
#endif

// Puts those of LANES entries behind `at` others into the group that touch the tile, one by one:
// stencils are drawn at once.
INLINED void put_one_by_one(SummedList* list, uint first, uint found, uint stencils, uint at,
                            PATCH lanes) {
  for (uint i = 0; i < LANES; ++i) {
#if STENCILS
    if (stencils >> i & 1u) {
      draw_stencil(list, first, (int)i);
      continue;
    }
#endif
    if (!(found >> i & 1u)) continue;
    const uint number = list->kinds.count++;
    move_entry(&list->group, at + i, number);
    count_kinds(&list->kinds, found >> i, 1u, number);
    if (list->kinds.count == ENTRIES_OF_GROUP) draw_group(list, lanes);
  }
}

// Draws LANES entries, or `count` if there are fewer, or puts them into the group.
INLINED void put_entries(SummedList* list, uint first, uint count, PATCH lanes) {
  const EntryLanes entries = load_entries(list->entries + first);
  uint stencils = 0;
#if STENCILS
  stencils = find_some_stencils(list, entries, count);
  if (stencils == 0xffu) {
    // As most are on blurred grids.
    for (int i = 0; i < LANES; ++i)
      draw_stencil(list, first, i);
    return;
  }
#endif
  const uint at = list->kinds.count;
  const uint found =
      find_entries(entries, list->entries, first, count, at, list->mean_sigma, &list->group);
  if (TOUCHING(found) != 0xffu || stencils != 0 || at > ENTRIES_OF_GROUP - LANES) {
    put_one_by_one(list, first, found, stencils, at, lanes);
    return;
  }
  count_kinds(&list->kinds, found, 0xffu, at);
  list->kinds.count += LANES;
  if (list->kinds.count == ENTRIES_OF_GROUP) draw_group(list, lanes);
}

INLINED void draw_list(float* tile, const Segment segment, const TileInPlanes* place,
                       __global const Grid* grid, uint grid_number,
                       __global const TileSplat* entries, __global float* partials,
                       const CompositeParameters* p, const CloudTables* clouds,
                       __global const Stencil* stencils, PATCH lanes) {
  SummedList list;
  list.tile = tile;
  list.entries = entries;
  list.of_tile = splat_tile(*grid, segment.tile, p);
  list.mean_sigma = grid->mean_sigma;
#ifdef SPLATS_OF_BLOCK
  float front[PLANES * TILE_PIXELS];
  clear_planes(front);
  list.front = front;
  list.drawn = 0;
#endif
#if STENCILS
  list.stencil = stencil_of_grid(stencils, grid_number);
  clear_stencils(&list.stencils);
#endif
  clear_kinds(&list.kinds);
  clear_waiting(&list.waiting);
  RowsAhead rows = rows_ahead(segment, place);
  for (uint k = segment.begin; k < segment.end; k += LANES) {
    ask_for_entries(entries + k + ENTRIES_AHEAD);
    ask_for_rows(&rows, place, LANES);
    put_entries(&list, k, segment.end - k, lanes);
  }
  if (list.kinds.count > 0) draw_group(&list, lanes);
  add_waiting(tile, &list.waiting);
#ifdef SPLATS_OF_BLOCK
  add_block(tile, front);
  store_segment(front, segment, place, partials);
#else
  store_segment(tile, segment, place, partials);
#endif
}
#endif
