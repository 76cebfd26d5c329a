// Particles to splats for GPUs: a work-item per particle, a group for each block of them, which
// writes its splats in the order of the file.
#include "kernels/common/common.cl"
#include "kernels/project/project.h"
#if DOUBLE_NUMBERS
#include "kernels/project/exact_point.cl"
#endif
#include "kernels/common/grid.h"
#include "kernels/common/group_sums.cl"
#include "kernels/common/lanes.cl"
#include "kernels/common/splat.h"
#include "kernels/project/depth_key.cl"
#include "kernels/project/load.cl"
#include "kernels/project/splat_arrays.cl"
#include "kernels/project/splat_lanes.cl"
#include "kernels/project/splat_place.cl"
#include "kernels/project/splat_widths.cl"
#include "kernels/project/wide_angle.cl"

#pragma OPENCL FP_CONTRACT OFF

INLINED SplatLanes no_splat(void) {
  SplatLanes none;
  none.visible = none.bad = none.unclear = none.too_sharp = none.around = 0;
  return none;
}

// Particle i, with what its depth key decides.
KERNEL_BODY void project_particle(uint i, const ProjectParameters* p,
                                  __global const WidthNeeds* width_needs, const SharpParameters* e,
                                  const Columns* columns, SplatLanes* lanes) {
  *lanes = project_lanes(i, p->launch.end_particle, *p, width_needs, *e, *columns);
  const int unclear = (lanes->visible | lanes->too_sharp) & lanes->unclear;
  if (unclear) {
    const int within = are_within_limits(i, p->launch.end_particle, unclear, *columns, *p);
    lanes->visible &= within;
    lanes->too_sharp &= within;
  }
}

// left_out[b] is that of a launch's group b, whose items meet every barrier all
// the same.
__kernel OF_GROUPS void project(PROJECT_PARAMETERS) {
  __local uint sums[GROUP_ITEMS];
  __local BlockCounts of_group;
  const uint item = get_local_id(0), block = p.launch.first_block + get_group_id(0);
  const uint bad_and_one = p.launch.leaves_out_blocks ? left_out[get_group_id(0)] : 0;
  __local KeyBins bins;
  if (item == 0) {
    of_group.visible = of_group.too_sharp = of_group.around = 0;
    of_group.bad = bad_and_one > 0 ? bad_and_one - 1 : 0;
    bins.least = ~0u;
    bins.most = 0;
  }
  const Columns columns = TAKEN_COLUMNS;
  const uint i = p.launch.first_particle + get_global_id(0);
  SplatLanes lanes = no_splat();
  if (i < p.launch.end_particle && bad_and_one == 0)
    project_particle(i, &p, width_needs, &e, &columns, &lanes);
  uint count = lanes.visible != 0;
  ulong key = 0;
  if (SORT_KEYS && count) {
    key = sort_keys_of(columns, i, p.launch.end_particle, lanes.sort_field, p);
    count = is_in_window(key, p);
  }
  Splat splat;
  SplatArrays found;
  if (count) {
    spread(lanes, 0, &found);
    splat = splat_of(&found, 0, component_colors, knots, p);
  }
  Copies copies = one_copy();
  if (COPIES && count) {
    copies = copies_of(&found, 0, p);
    count = copies.first > copies.last ? 0u : (uint)(copies.last - copies.first + 1);
  }
  uint total;
  uint slot = p.launch.first_slot + offsets[block] + group_scan(count, sums, &total);
  for (uint k = 0; OUTPUT_SPLATS && k < count; ++k, ++slot) {
    Splat listed = splat;
    if (COPIES) put_copy(&listed, copy_of_number(copies.first + (int)k, copies), p);
    splats[slot] = listed;
    if (OUTPUT_KEYS) {
      keys[slot] = (uint)(key >> 16);
      if (!p.sort_by_field) key_ends[slot] = (ushort)key;
    }
  }
  if (lanes.bad) atomic_inc(&of_group.bad);
  if (lanes.too_sharp) atomic_inc(&of_group.too_sharp);
  if (CLOUDS_AROUND && lanes.around) atomic_inc(&of_group.around);
  if (COUNT_KEYS && count > 0) {
    const uint bin = bin_of(key, p);
    atomic_add(&key_counts[bin], count);
    atomic_min(&bins.least, bin);
    atomic_max(&bins.most, bin);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  if (item == 0) {
    of_group.visible = total;
    counts[block] = of_group;
    if (COUNT_KEYS) key_bins[get_group_id(0)] = bins;
  }
}
