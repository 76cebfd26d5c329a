// Entries of a sum's list, gathered into groups of so many that touch the tile. Which these are is
// the same for a crop, whose lists have others that do not touch it (splat.h): so it has the bits
// of the whole picture, in whatever order those of a group are drawn.
#include "kernels/bin/bin.h"
#include "kernels/bin/entry_lanes.cl"
#include "kernels/common/common.cl"
#include "kernels/common/lanes.cl"
#include "kernels/composite/entry_windows.cl"
#include "kernels/composite/narrow_splats.cl"

#if !LIGHT_ORDERED
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
#endif
