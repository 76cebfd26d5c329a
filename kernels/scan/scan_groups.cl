// Exclusive sums over long lists: every group adds up a stretch of SCAN_STRETCH values, these sums
// are scanned likewise, or, where one group could scan them, added up by every group; and every
// group goes through its stretch again from what lies before it.
#include "kernels/common/common.cl"
#include "kernels/common/group_sums.cl"
#include "kernels/scan/scan.h"

INLINED uint value_or_0(__global const uint* values, uint i, const ScanParameters p) {
  return i < p.count ? values[i] : 0u;
}

__kernel OF_GROUPS void scan_reduce(const ScanParameters p, __global const uint* values,
                                    __global uint* sums_of_groups) {
  __local uint sums[GROUP_ITEMS];
  const uint item = get_local_id(0), group = get_group_id(0);
  uint sum = 0, total;
  for (uint k = 0; k < SCAN_VALUES_OF_ITEM; ++k)
    sum += value_or_0(values, group * SCAN_STRETCH + k * GROUP_ITEMS + item, p);
  group_scan(sum, sums, &total);
  if (item == 0) sums_of_groups[group] = total;
}

// Of the stretches before this group's.
INLINED uint sum_of_groups(__global const uint* sums_of_groups, uint group, __local uint* sums) {
  uint sum = 0, total;
  for (uint before = get_local_id(0); before < group; before += GROUP_ITEMS)
    sum += sums_of_groups[before];
  group_scan(sum, sums, &total);
  return total;
}

// In place; the place behind the last value takes the sum of all.
__kernel OF_GROUPS void scan_stretches(const ScanParameters p, __global uint* values,
                                       __global const uint* before_groups) {
  __local uint sums[GROUP_ITEMS];
  const uint item = get_local_id(0), group = get_group_id(0);
  const uint first = group * SCAN_STRETCH + item * SCAN_VALUES_OF_ITEM;
  uint own[SCAN_VALUES_OF_ITEM];
  uint sum = 0, total;
  for (uint k = 0; k < SCAN_VALUES_OF_ITEM; ++k) {
    own[k] = value_or_0(values, first + k, p);
    sum += own[k];
  }
  const uint before =
      p.adds_up_groups ? sum_of_groups(before_groups, group, sums) : before_groups[group];
  uint running = before + group_scan(sum, sums, &total);
  for (uint k = 0; k < SCAN_VALUES_OF_ITEM; ++k) {
    if (first + k < p.count) values[first + k] = running;
    running += own[k];
    if (first + k + 1 == p.count) values[p.count] = running;
  }
  if (p.count == 0 && item == 0) values[0] = 0;
}
