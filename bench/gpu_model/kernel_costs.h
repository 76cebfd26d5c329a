#pragma once

#include <cstdint>
#include <string>

namespace splotchcl::bench {

// What a frame gave the kernels of the shape for GPUs to do.
struct FrameWork {
  bool is_ordered = false;
  double planes = 3;          // floats per pixel
  double particle_bytes = 0;  // of all columns of one particle
  double splat_bytes = 0, entry_bytes = 0;
  double splats_per_particle = 1;
  double particles = 0, splats = 0, entries = 0;
  double drawn_parts = 0;     // eighths of tiles that entries touch: 32 pixels each
  double longest_list = 0;    // of one chunk in one tile
  double chunk = 0;           // particles or splats at most in one
  double segment_length = 0;  // entries at most that one group draws
  double tiles = 0;
};

// All launches of one kernel in one frame. Bytes are those of global memory that are asked for:
// what is read by many work-items of a group at once counts once, what is gathered counts in
// sectors of 32 bytes. Operations are those of single lanes, a multiplication with an addition
// being one.
struct KernelCost {
  double bytes_read = 0, bytes_written = 0;
  double operations = 0;
  // The longest chain of steps of one work-item in one launch: rounds of loops, those of scans in
  // a group included.
  double chain = 0;
  int barriers = 0;  // of one group, at most
};

// `items` are work-items in all `launches`. Throws UsageError for a kernel that it does not know.
KernelCost cost_of(const std::string& kernel, double items, double launches, const FrameWork& work);

}  // namespace splotchcl::bench
