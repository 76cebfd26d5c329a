// Work-groups of the shape for GPUs: the same on every device, so that the same sums are done
// in the same order.
#pragma once

#define GROUP_ITEMS 256
