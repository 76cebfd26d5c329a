// The stable radix sort of sort.cl for GPUs: a work-group takes SORT_STRETCH pairs, sorts them in
// local memory by the pass's digit, and writes runs of equal digits to where they belong. No group
// waits for another.
#include "kernels/common/common.cl"
#include "kernels/common/group_sums.cl"
#include "kernels/sort/short_run.cl"
#include "kernels/sort/sort.h"

INLINED uint digit_of(uint key, const GroupSortParameters p) {
  return (key >> p.shift) & ((1u << p.bits) - 1u);
}

// histograms[d * group_count + group]. SORT_DIGITS are GROUP_ITEMS: a digit for each item.
__kernel OF_GROUPS void sort_count(const GroupSortParameters p, __global const uint* keys,
                                   __global uint* histograms) {
  __local uint counts[SORT_DIGITS];
  const uint item = get_local_id(0), group = get_group_id(0);
  counts[item] = 0;
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint k = 0; k < SORT_PAIRS_OF_ITEM; ++k) {
    const uint i = group * SORT_STRETCH + k * GROUP_ITEMS + item;
    if (i < p.count) atomic_inc(&counts[digit_of(keys[i] - p.smallest, p)]);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  if (item < 1u << p.bits) histograms[item * p.group_count + group] = counts[item];
}

// A group's pairs in local memory. What lies one behind the other is read sixteen bytes at a time:
// read one by one, the numbers of neighboring items would lie in the same banks.
#define SPLIT_BITS 4
#define SPLIT_DIGITS (1 << SPLIT_BITS)
typedef struct GroupPairs {
  uint4 keys[SORT_STRETCH / 4], values[SORT_STRETCH / 4];
  // Of each digit and item: how many of its pairs have it, then where the next of them goes.
  ushort8 places[SPLIT_DIGITS * GROUP_ITEMS / 8];
  uint sums[GROUP_ITEMS];
  uint starts[SORT_DIGITS];
} GroupPairs;
REQUIRE(two_fours_of_pairs, SORT_PAIRS_OF_ITEM == 8);
REQUIRE(two_eights_of_counts, SPLIT_DIGITS == 16);

INLINED void load_pairs(const __local uint4* from, uint item, uint* to) {
  vstore4(from[2 * item], 0, to);
  vstore4(from[2 * item + 1], 1, to);
}

INLINED uint sum_of_eight(ushort8 counts) {
  const ushort4 four = counts.lo + counts.hi;
  const ushort2 two = four.lo + four.hi;
  return (uint)two.x + two.y;
}

// Each count's place behind those before it, of which there are `before`.
INLINED ushort8 places_behind(ushort8 counts, uint before) {
  ushort8 places;
  places.s0 = (ushort)before;
  places.s1 = places.s0 + counts.s0;
  places.s2 = places.s1 + counts.s1;
  places.s3 = places.s2 + counts.s2;
  places.s4 = places.s3 + counts.s3;
  places.s5 = places.s4 + counts.s4;
  places.s6 = places.s5 + counts.s5;
  places.s7 = places.s6 + counts.s6;
  return places;
}

// An item takes as many counts as there are digits, one after the other: all of them together are
// scanned in the order of digits, then items.
INLINED void scan_places(__local GroupPairs* pairs) {
  __local ushort8* own = pairs->places + 2 * get_local_id(0);
  const uint of_first = sum_of_eight(own[0]);
  uint total;
  const uint before = group_scan(of_first + sum_of_eight(own[1]), pairs->sums, &total);
  own[0] = places_behind(own[0], before);
  own[1] = places_behind(own[1], before + of_first);
}

// Orders the group's pairs by SPLIT_BITS bits of their keys, stable.
INLINED void split_pairs(__local GroupPairs* pairs, uint shift, uint mask) {
  const uint item = get_local_id(0);
  __local ushort* places = (__local ushort*)pairs->places;
  uint keys[SORT_PAIRS_OF_ITEM], values[SORT_PAIRS_OF_ITEM];
  for (uint d = 0; d < SPLIT_DIGITS; ++d)
    places[d * GROUP_ITEMS + item] = 0;
  load_pairs(pairs->keys, item, keys);
  load_pairs(pairs->values, item, values);
  for (uint k = 0; k < SORT_PAIRS_OF_ITEM; ++k)
    ++places[((keys[k] >> shift) & mask) * GROUP_ITEMS + item];
  barrier(CLK_LOCAL_MEM_FENCE);
  scan_places(pairs);
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint k = 0; k < SORT_PAIRS_OF_ITEM; ++k) {
    const uint place = places[((keys[k] >> shift) & mask) * GROUP_ITEMS + item]++;
    ((__local uint*)pairs->keys)[place] = keys[k];
    ((__local uint*)pairs->values)[place] = values[k];
  }
  barrier(CLK_LOCAL_MEM_FENCE);
}

__kernel OF_GROUPS void sort_scatter(const GroupSortParameters p, __global const uint* keys,
                                     __global const uint* values, __global const uint* histograms,
                                     __global uint* sorted_keys, __global uint* sorted_values) {
  __local GroupPairs pairs;
  __local uint* own_keys = (__local uint*)pairs.keys;
  __local uint* own_values = (__local uint*)pairs.values;
  const uint item = get_local_id(0), group = get_group_id(0);
  const uint first = group * SORT_STRETCH, count = min((uint)SORT_STRETCH, p.count - first);
  for (uint k = 0; k < SORT_PAIRS_OF_ITEM; ++k) {
    const uint i = k * GROUP_ITEMS + item;
    // Beyond the last pair the largest of keys: they stay at the end.
    own_keys[i] = i < count ? keys[first + i] - p.smallest : ~0u;
    own_values[i] = i < count ? values[first + i] : 0u;
  }
  pairs.starts[item] = 0;
  barrier(CLK_LOCAL_MEM_FENCE);
  const uint low_bits = min(p.bits, (uint)SPLIT_BITS), high_bits = p.bits - low_bits;
  split_pairs(&pairs, p.shift, (1u << low_bits) - 1u);
  if (high_bits > 0) split_pairs(&pairs, p.shift + low_bits, (1u << high_bits) - 1u);
  for (uint k = 0; k < SORT_PAIRS_OF_ITEM; ++k) {
    const uint i = k * GROUP_ITEMS + item, digit = digit_of(own_keys[i], p);
    if (i > 0 && digit_of(own_keys[i - 1], p) != digit) pairs.starts[digit] = i;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  // From a place in the group to one in the whole list; it may wrap around.
  if (item < 1u << p.bits)
    pairs.sums[item] = histograms[item * p.group_count + group] - pairs.starts[item];
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint k = 0; k < SORT_PAIRS_OF_ITEM; ++k) {
    const uint i = k * GROUP_ITEMS + item;
    if (i >= count) continue;
    const uint place = i + pairs.sums[digit_of(own_keys[i], p)];
    sorted_keys[place] = own_keys[i];
    sorted_values[place] = own_values[i];
  }
}

// The smallest and the largest key, and the bits that are set in some and in all.
__kernel OF_GROUPS void sort_range(const GroupSortParameters p, __global const uint* keys,
                                   __global KeyRange* range) {
  __local KeyRange own;
  const uint item = get_local_id(0);
  if (item == 0) {
    own.smallest = own.bits.all = ~0u;
    own.largest = own.bits.some = 0;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  uint smallest = ~0u, largest = 0, some = 0, all = ~0u;
  for (uint k = 0; k < SORT_PAIRS_OF_ITEM; ++k) {
    const uint i = get_group_id(0) * SORT_STRETCH + k * GROUP_ITEMS + item;
    if (i >= p.count) continue;
    const uint key = keys[i];
    smallest = min(smallest, key);
    largest = max(largest, key);
    some |= key;
    all &= key;
  }
  atomic_min(&own.smallest, smallest);
  atomic_max(&own.largest, largest);
  atomic_or(&own.bits.some, some);
  atomic_and(&own.bits.all, all);
  barrier(CLK_LOCAL_MEM_FENCE);
  if (item > 0) return;
  atomic_min(&range->smallest, own.smallest);
  atomic_max(&range->largest, own.largest);
  atomic_or(&range->bits.some, own.bits.some);
  atomic_and(&range->bits.all, own.bits.all);
}

// Keys of 48 bits, as in sort.cl. Those of the smallest upper bits lose them, and `shift` upper
// bits that then are 0 make room for as many of the ends', which lie where the values say.
__kernel OF_GROUPS void sort_join_ends(const GroupSortParameters p, __global const ushort* ends,
                                       __global const uint* values, __global uint* keys) {
  const uint i = get_global_id(0);
  if (i >= p.count) return;
  keys[i] = ((keys[i] - p.smallest) << p.shift) | ((uint)ends[values[i]] >> (16u - p.shift));
}

// Puts each run of equal sorted keys into the order of their ends; those beyond SORT_SHORT_RUN are
// only told of.
__kernel OF_GROUPS void sort_short_runs(const GroupSortParameters p, __global const uint* keys,
                                        __global const ushort* ends, __global uint* values,
                                        __global uint* has_long_runs) {
  const uint i = get_global_id(0);
  if (i + 1 >= p.count) return;
  const uint key = keys[i];
  if (keys[i + 1] != key || (i > 0 && keys[i - 1] == key)) return;
  uint length = 2;
  while (length <= SORT_SHORT_RUN && i + length < p.count && keys[i + length] == key)
    ++length;
  if (length > SORT_SHORT_RUN) {
    atomic_or(has_long_runs, 1u);
  } else {
    sort_short_run(ends, values + i, length);
  }
}

// Then all pairs are sorted by their ends, and once more by their keys: as keys the ends, as values
// the pairs' places ...
__kernel OF_GROUPS void sort_take_ends(const GroupSortParameters p, __global const uint* values,
                                       __global const ushort* ends, __global uint* keys,
                                       __global uint* places) {
  const uint i = get_global_id(0);
  if (i >= p.count) return;
  keys[i] = ends[values[i]];
  places[i] = i;
}

// ... and from places to pairs.
__kernel OF_GROUPS void sort_take_pairs(const GroupSortParameters p, __global const uint* places,
                                        __global const uint* keys, __global const uint* values,
                                        __global uint* keys_in_order,
                                        __global uint* values_in_order) {
  const uint i = get_global_id(0);
  if (i >= p.count) return;
  const uint place = places[i];
  keys_in_order[i] = keys[place];
  values_in_order[i] = values[place];
}
