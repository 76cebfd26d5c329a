// Entries of a list that are looked at before they are drawn: in order eight, in sums as many as
// are drawn kind by kind (summed_list.cl), and room for eight more.
#include "kernels/bin/bin.h"
#include "kernels/bin/entry_lanes.cl"
#include "kernels/common/common.cl"
#include "kernels/common/lanes.cl"
#include "kernels/composite/rows.cl"

#if LIGHT_ORDERED
#define ROOM_OF_ENTRIES LANES
#else
#define ENTRIES_OF_GROUP 64
#define ROOM_OF_ENTRIES (ENTRIES_OF_GROUP + LANES)
#endif

// The rows and columns of their tile that entries touch, found for eight of them at once: to find
// those of one takes a processor as long as to draw a small splat, since each step waits for the
// last.
typedef struct EntryWindows {
  int first_row[ROOM_OF_ENTRIES], last_row[ROOM_OF_ENTRIES];
  int first_column[ROOM_OF_ENTRIES], last_column[ROOM_OF_ENTRIES];
} EntryWindows;

// pixel_range() of common.cl, of eight.
INLINED void fill_range(VALUE center, VALUE radius, float first_center, int size, int* first,
                        int* last) {
  const VALUE none = (VALUE)(0.0f), end = (VALUE)((float)size);
  const VALUE low = center - radius - first_center, high = center + radius - first_center;
  const VALUE from = choose(none, choose(end, low, low < end), low > none);
  const VALUE to = choose(end - 1.0f, choose(none - 1.0f, high, high > -1.0f), high < end - 1.0f);
  const INTEGER truncated_from = TO_INTEGER(from), truncated_to = TO_INTEGER(to);
  // A vector's comparison gives -1.
  STORE(truncated_from - (TO_VALUE(truncated_from) < from), first);
  STORE(truncated_to + (TO_VALUE(truncated_to) > to), last);
}

// Of eight entries, numbers `at` and on.
INLINED void find_windows(const EntryLanes lanes, __global const TileSplat* entries, uint at,
                          EntryWindows* windows) {
#if ELLIPSES
  const VALUE radius_x = OF_ENTRIES(entries, along_x.radius);
#else
  const VALUE radius_x = lanes.radius;
#endif
  fill_range(lanes.y, lanes.radius, FIRST_Y, TILE_HEIGHT, windows->first_row + at,
             windows->last_row + at);
  fill_range(lanes.x, radius_x, FIRST_X, TILE_WIDTH, windows->first_column + at,
             windows->last_column + at);
}

// More than a group: while one is drawn, the next comes.
#define ENTRIES_AHEAD 96

static inline int2 rows_of_entry(const EntryWindows* windows, int i) {
  return (int2)(windows->first_row[i], windows->last_row[i]);
}
static inline int2 columns_of_entry(const EntryWindows* windows, int i) {
  return (int2)(windows->first_column[i], windows->last_column[i]);
}
