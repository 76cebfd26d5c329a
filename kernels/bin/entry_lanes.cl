// What LANES entries of a list hold from one on, as a VALUE (lanes.cl). Behind the last list there
// is room for as many (bin.h, ENTRIES_BEHIND): of a list's last ones some may be of the next, or
// hold nothing, and do not count.
#ifdef LANES_8
#define OF_ENTRIES(entries, field)                                                         \
  ((VALUE)((entries)[0].field, (entries)[1].field, (entries)[2].field, (entries)[3].field, \
           (entries)[4].field, (entries)[5].field, (entries)[6].field, (entries)[7].field))
#else
#define OF_ENTRIES(entries, field) ((entries)[0].field)
#endif

#if LANES > 1
// LANES entries from one on. Lists are read from front to back, but not every processor sees that,
// or early enough.
INLINED void ask_for_entries(__global const TileSplat* entries) {
  for (uint i = 0; i < LANES * sizeof(TileSplat) / sizeof(uint); i += NUMBERS_OF_LINE)
    ask_for((__global const uint*)entries + i);
}
#endif
