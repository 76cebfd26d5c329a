// Which particles are around the camera, and by which keys they are sorted.
#include "kernels/common/common.cl"
#include "kernels/common/lanes.cl"
#include "kernels/project/depth_key.cl"
#include "kernels/project/load.cl"
#include "kernels/project/project.h"
#include "kernels/project/view.cl"

#pragma OPENCL FP_CONTRACT OFF

// A key that no splat has, of particles beyond the limits that the scene sets.
#define BEYOND_LIMITS (1UL << 48)

INLINED UNSIGNED_WIDE keys_within_limits(const Columns columns, uint i, uint end,
                                         const ParticleLanes particles, const ProjectParameters p) {
  const UNSIGNED_WIDE depth = depth_of(particles.position, p.depth_key).key;
  const INTEGER within =
      TO_INTEGER(depth >= (UNSIGNED_WIDE)((ulong)wide_integer(p.depth_key.near_key))) &
      TO_INTEGER(depth <= (UNSIGNED_WIDE)((ulong)wide_integer(p.depth_key.far_key)));
  return choose_wide((UNSIGNED_WIDE)(BEYOND_LIMITS),
                     sort_keys_of(columns, i, end, particles.sort_field, p), within);
}

KERNEL_BODY void list_block(const ProjectParameters* of_frame, const Columns* of_particles,
                            uint block, __global uint* listed, uint capacity) {
  const ProjectParameters p = *of_frame;
  const Columns columns = *of_particles;
  const uint begin = p.launch.first_particle + block * p.launch.block_particles;
  const uint end = min(begin + p.launch.block_particles, p.launch.end_particle);
  for (uint i = begin; i < end; i += LANES) {
    const ParticleLanes particles = load_particles(columns, i, end, p);
    const Vectors offset = offset_from(particles.position, p.position_high, p.position_low);
    const INTEGER around =
        particles.exists & are_good(particles, offset) & are_around(particles.h, offset, p);
    if (!ANY(around)) continue;
    int is_around[LANES];
    STORE(around, is_around);
    long keys[LANES];
    STORE(AS_WIDE(keys_within_limits(columns, i, end, particles, p)), keys);
    for (uint k = 0; k < LANES; ++k) {
      if (!is_around[k]) continue;
      const uint place = atomic_inc(&listed[0]) + 1;
      if (place > capacity) continue;
      const ulong key = (ulong)keys[k];
      listed[3 * place] = i + k;
      listed[3 * place + 1] = (uint)key;
      listed[3 * place + 2] = (uint)(key >> 32);
    }
  }
}

// Work-item: one of the blocks of particles that `blocks` numbers. `listed[0]` counts them, and
// three words each from listed[3] on take a particle and the low and the high word of its key, in
// any order.
__kernel void list_around(const ProjectParameters p, COLUMN_PARAMETERS, __global const uint* blocks,
                          __global uint* listed, const uint capacity) {
  const Columns columns = TAKEN_COLUMNS;
  list_block(&p, &columns, blocks[get_global_id(0)], listed, capacity);
}
