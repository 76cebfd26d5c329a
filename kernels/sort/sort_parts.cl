// The order of splats that lie in runs of parts of their sort keys (key_parts.cl). A work-item
// sorts one part, which fits into a core's caches: by two digits of the leading bits of its keys,
// in two stable passes; splats that agree in those by all bits. Within a run they have the order of
// their particles, and so have those of equal keys in the end.
#include "kernels/common/pieces.cl"
#include "kernels/common/prefetch.cl"
#include "kernels/sort/sort.h"

// 32 bits of a splat's key, and below them where it lies.
typedef ulong PartEntry;

static inline uint slot_of(PartEntry entry) {
  return (uint)entry;
}
static inline uint bits_of(PartEntry entry) {
  return (uint)(entry >> 32);
}
static inline uint high_digit(PartEntry entry) {
  return (uint)(entry >> (64 - PART_DIGIT_BITS));
}
static inline uint low_digit(PartEntry entry) {
  return (uint)(entry >> (64 - 2 * PART_DIGIT_BITS)) & (PART_DIGITS - 1);
}
static inline uint digits_of(PartEntry entry) {
  return (uint)(entry >> (64 - 2 * PART_DIGIT_BITS));
}

static inline PartEntry entry_of(uint slot, uint upper, uint end, const PartOfKeys part) {
  if (upper < part.first_key) return slot;
  if (upper > part.last_key) return 0xffffffff00000000UL | slot;
  const ulong above = (ulong)(upper - part.first_key) << 16 | end;
  // Of 48 bits to the left of 64 the upper 32.
  return (above << (16 + part.zeros) & 0xffffffff00000000UL) | slot;
}

static inline ulong key_of(uint slot, __global const uint* keys, __global const ushort* ends,
                           uint has_ends) {
  return (ulong)keys[slot] << 16 | (has_ends ? ends[slot] : 0u);
}

// Counts become places.
static inline void scan_digits(uint* counts) {
  uint running = 0;
  for (uint digit = 0; digit < PART_DIGITS; ++digit) {
    const uint count = counts[digit];
    counts[digit] = running;
    running += count;
  }
}

// Most differ in the 32 bits that they have with them.
static inline int is_behind(PartEntry a, PartEntry b, __global const uint* keys,
                            __global const ushort* ends, uint has_ends) {
  if (bits_of(a) != bits_of(b)) return bits_of(a) > bits_of(b);
  return key_of(slot_of(a), keys, ends, has_ends) > key_of(slot_of(b), keys, ends, has_ends);
}

static inline void sort_short_run_by_keys(__global PartEntry* run, uint length,
                                          __global const uint* keys, __global const ushort* ends,
                                          uint has_ends) {
  for (uint i = 1; i < length; ++i) {
    const PartEntry entry = run[i];
    uint place = i;
    for (; place > 0 && is_behind(run[place - 1], entry, keys, ends, has_ends); --place)
      run[place] = run[place - 1];
    run[place] = entry;
  }
}

// By one digit after the other. Digits that all have in common take no pass.
static inline void sort_long_run_by_keys(__global PartEntry* run, __global PartEntry* scratch,
                                         uint length, __global const uint* keys,
                                         __global const ushort* ends, uint has_ends) {
  for (uint shift = 0; shift < 48; shift += SORT_DIGIT_BITS) {
    uint next[SORT_DIGITS];
    for (uint d = 0; d < SORT_DIGITS; ++d)
      next[d] = 0;
    for (uint i = 0; i < length; ++i)
      ++next[key_of(slot_of(run[i]), keys, ends, has_ends) >> shift & (SORT_DIGITS - 1)];
    if (next[key_of(slot_of(run[0]), keys, ends, has_ends) >> shift & (SORT_DIGITS - 1)] == length)
      continue;
    uint running = 0;
    for (uint d = 0; d < SORT_DIGITS; ++d) {
      const uint count = next[d];
      next[d] = running;
      running += count;
    }
    for (uint i = 0; i < length; ++i) {
      const ulong key = key_of(slot_of(run[i]), keys, ends, has_ends);
      scratch[next[key >> shift & (SORT_DIGITS - 1)]++] = run[i];
    }
    for (uint i = 0; i < length; ++i)
      run[i] = scratch[i];
  }
}

// A call: hardly any entries are those of a run.
__attribute__((noinline)) static uint sort_run_by_keys(__global PartEntry* run,
                                                       __global PartEntry* scratch, uint left,
                                                       __global const uint* keys,
                                                       __global const ushort* ends, uint has_ends) {
  uint length = 1;
  while (length < left && digits_of(run[length]) == digits_of(run[0]))
    ++length;
  if (length <= SORT_SHORT_RUN)
    sort_short_run_by_keys(run, length, keys, ends, has_ends);
  else
    sort_long_run_by_keys(run, scratch, length, keys, ends, has_ends);
  return length;
}

// Blocks whose runs are asked for before they are read.
#define RUNS_OF_PART_AHEAD 4

// The part's splats of all blocks, one block after the other, and how many have each digit; how
// many there are. `others` will be written to all over, and is asked for in order here.
static inline uint gather_entries(const PartSortParameters p, uint number, const PartOfKeys part,
                                  __global const uint* first_slots, __global const uint* keys,
                                  __global const ushort* ends, __global PartEntry* entries,
                                  __global const PartEntry* others, uint* low, uint* high) {
  const size_t stride = p.part_count + 1;
  const uint last_block = p.block_count - 1;
  uint count = 0;
  for (uint block = 0; block < p.block_count; ++block) {
    __global const uint* starts = first_slots + block * stride + number;
    ask_for(keys + first_slots[min(block + RUNS_OF_PART_AHEAD, last_block) * stride + number]);
    for (uint slot = starts[0]; slot < starts[1]; ++slot) {
      const PartEntry entry = entry_of(slot, keys[slot], p.has_ends ? ends[slot] : 0u, part);
      ask_to_write(others + count);
      entries[count++] = entry;
      ++low[low_digit(entry)];
      ++high[high_digit(entry)];
    }
  }
  return count;
}

// There and back. The counts of digits are used up.
static inline void sort_by_digits(__global PartEntry* entries, __global PartEntry* others,
                                  uint count, uint* low, uint* high) {
  scan_digits(low);
  scan_digits(high);
  for (uint i = 0; i < count; ++i) {
    const PartEntry entry = entries[i];
    others[low[low_digit(entry)]++] = entry;
  }
  for (uint i = 0; i < count; ++i) {
    const PartEntry entry = others[i];
    entries[high[high_digit(entry)]++] = entry;
  }
}

// Work-item: one part. `scratch` has room for the splats of all parts of the launch, twice.
__kernel void sort_parts(const PartSortParameters p, __global const PartOfKeys* parts,
                         __global const uint* first_slots, __global const uint* keys,
                         __global const ushort* ends, __global PartEntry* scratch,
                         __global uint* order) {
  const uint sorted = piece_of_item(p.sorted_parts);
  if (sorted == NO_PIECE) return;
  const uint number = p.first_part + sorted;
  const PartOfKeys part = parts[number];
  __global PartEntry* entries = scratch + part.first_scratch;
  __global PartEntry* others = entries + p.scratch_half;
  uint low[PART_DIGITS], high[PART_DIGITS];
  for (uint digit = 0; digit < PART_DIGITS; ++digit)
    low[digit] = high[digit] = 0;
  const uint count =
      gather_entries(p, number, part, first_slots, keys, ends, entries, others, low, high);
  sort_by_digits(entries, others, count, low, high);
  for (uint i = 0; i + 1 < count; ++i) {
    if (digits_of(entries[i]) != digits_of(entries[i + 1])) continue;
    i += sort_run_by_keys(entries + i, others + i, count - i, keys, ends, p.has_ends) - 1;
  }
  for (uint i = 0; i < count; ++i)
    order[part.first_place + i] = slot_of(entries[i]);
}
