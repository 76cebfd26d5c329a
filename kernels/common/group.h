// Work-groups of the shape for GPUs: the same on every device, so that the same sums are done
// in the same order.
#ifndef SPLOTCHCL_GROUP_H
#define SPLOTCHCL_GROUP_H

#define GROUP_ITEMS 256

#endif
