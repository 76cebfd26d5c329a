// What LANES entries of a list hold from one on, as a VALUE (lanes.cl). Behind the last list there
// is room for as many (bin.h, ENTRIES_BEHIND): of a list's last ones some may be of the next, or
// hold nothing, and do not count.
#include "kernels/bin/bin.h"
#include "kernels/common/common.cl"
#include "kernels/common/lanes.cl"

#ifdef LANES_8
#define OF_ENTRIES(entries, field)                                                         \
  ((VALUE)((entries)[0].field, (entries)[1].field, (entries)[2].field, (entries)[3].field, \
           (entries)[4].field, (entries)[5].field, (entries)[6].field, (entries)[7].field))
#else
#define OF_ENTRIES(entries, field) ((entries)[0].field)
#endif

// Four neighbors of the fields of LANES entries.
typedef struct FieldLanes {
  VALUE first, second, third, fourth;
} FieldLanes;

#ifdef LANES_8
INLINED float8 four_fields(__global const TileSplat* a, __global const TileSplat* b, uint first) {
  return (float8)(load_global_four((__global const float*)a + first),
                  load_global_four((__global const float*)b + first));
}

// From word `first` of an entry on. Entry by entry to field by field in registers: gathered one by
// one they take twice as many instructions.
INLINED FieldLanes load_fields(__global const TileSplat* entries, uint first) {
  const float8 a = four_fields(entries, entries + 4, first);
  const float8 b = four_fields(entries + 1, entries + 5, first);
  const float8 c = four_fields(entries + 2, entries + 6, first);
  const float8 d = four_fields(entries + 3, entries + 7, first);
  const float8 first_ab = first_words(a, b), first_cd = first_words(c, d);
  const float8 last_ab = last_words(a, b), last_cd = last_words(c, d);
  FieldLanes lanes;
  lanes.first = first_pairs(first_ab, first_cd);
  lanes.second = last_pairs(first_ab, first_cd);
  lanes.third = first_pairs(last_ab, last_cd);
  lanes.fourth = last_pairs(last_ab, last_cd);
  return lanes;
}
#else
INLINED FieldLanes load_fields(__global const TileSplat* entries, uint first) {
  __global const float* const fields = (__global const float*)entries + first;
  FieldLanes lanes;
  lanes.first = fields[0];
  lanes.second = fields[1];
  lanes.third = fields[2];
  lanes.fourth = fields[3];
  return lanes;
}
#endif

// What all entries begin with (bin.h).
typedef struct EntryLanes {
  VALUE x, y, sigma, radius;
} EntryLanes;

INLINED EntryLanes load_entries(__global const TileSplat* entries) {
  const FieldLanes fields = load_fields(entries, 0);
  EntryLanes lanes;
  lanes.x = fields.first;
  lanes.y = fields.second;
  lanes.sigma = fields.third;
  lanes.radius = fields.fourth;
  return lanes;
}

#if LANES > 1
// LANES entries from one on. Lists are read from front to back, but not every processor sees that,
// or early enough.
INLINED void ask_for_entries(__global const TileSplat* entries) {
  for (uint i = 0; i < LANES * sizeof(TileSplat) / sizeof(uint); i += NUMBERS_OF_LINE)
    ask_for((__global const uint*)entries + i);
}
#endif
