// Offsets of the blocks of a projection: offsets[b] is the number of visible particles in
// all blocks before b. Blocks are few (thousands), so one work-item walks them.
#include "kernels/project/project.h"

__kernel void scan_blocks(uint block_count, __global const BlockCounts* counts,
                          __global uint* offsets) {
  if (get_global_id(0) != 0) return;
  uint running = 0;
  for (uint b = 0; b < block_count; ++b) {
    offsets[b] = running;
    running += counts[b].visible;
  }
  offsets[block_count] = running;
}
