// What host and kernels share of scans over long lists.
#include "kernels/common/group.h"

#pragma once

#define SCAN_VALUES_OF_ITEM 8
#define SCAN_STRETCH (GROUP_ITEMS * SCAN_VALUES_OF_ITEM)

typedef struct ScanParameters {
  unsigned int count;  // values
  // Sums of stretches are not scanned: every group adds up those before it.
  unsigned int adds_up_groups;
} ScanParameters;
