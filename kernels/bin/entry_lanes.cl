// LANES entries of a tile's list, and what they hold as a VALUE (lanes.cl).
typedef struct Entries {
  __global const TileSplat* lane[LANES];
} Entries;

#ifdef LANES_8
#define OF_ENTRIES(entries, field)                                                       \
  ((VALUE)((entries).lane[0]->field, (entries).lane[1]->field, (entries).lane[2]->field, \
           (entries).lane[3]->field, (entries).lane[4]->field, (entries).lane[5]->field, \
           (entries).lane[6]->field, (entries).lane[7]->field))
#else
#define OF_ENTRIES(entries, field) ((entries).lane[0]->field)
#endif

// The first `count` from this one on, which is there; the others are the first once more.
INLINED Entries entries_from(__global const TileSplat* first, int count) {
  Entries entries;
  for (int i = 0; i < LANES; ++i)
    entries.lane[i] = first + (i < count ? i : 0);
  return entries;
}
