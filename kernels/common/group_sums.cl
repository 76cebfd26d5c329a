// Sums over the work-items of a group, in log2(GROUP_ITEMS) steps. All of its items call these,
// in uniform control flow; `sums` are GROUP_ITEMS numbers in local memory, free again afterwards.
#include "kernels/common/common.cl"
#include "kernels/common/group.h"

#define OF_GROUPS __attribute__((reqd_work_group_size(GROUP_ITEMS, 1, 1)))

// Of the values of the items before this one; *total takes that of all.
INLINED uint group_scan(uint value, __local uint* sums, uint* total) {
  const uint item = get_local_id(0);
  sums[item] = value;
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint step = 1; step < GROUP_ITEMS; step *= 2) {
    const uint before = item >= step ? sums[item - step] : 0u;
    barrier(CLK_LOCAL_MEM_FENCE);
    sums[item] += before;
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  *total = sums[GROUP_ITEMS - 1];
  const uint before = sums[item] - value;
  barrier(CLK_LOCAL_MEM_FENCE);
  return before;
}
