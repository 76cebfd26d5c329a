#pragma once

#include <cstdint>
#include <set>
#include <string>

namespace splotchcl::bench {

// What a frame gave the kernels of the shape for GPUs to do.
struct FrameWork {
  bool is_ordered = false, is_extended = false;
  double planes = 3;          // floats per pixel
  double particle_bytes = 0;  // of all columns of one particle
  double splat_bytes = 0, entry_bytes = 0;
  double extended_splat_bytes = 0;  // of each, where there are some
  double splats_per_particle = 1;
  double particles = 0, splats = 0, entries = 0;
  // Eighths of tiles that entries touch, 32 pixels each: by how exactly layers are taken.
  double thin_parts = 0, series_parts = 0, full_parts = 0;
  double slab_parts = 0;  // of an ordered frame's coarse grids, which add up six numbers
  double drawn_parts() const { return thin_parts + series_parts + full_parts + slab_parts; }
  // Entries whose axes take the error function, and those of bright splats, which take it with all
  // its digits.
  double mean_entries = 0, bright_entries = 0;
  double longest_list = 0;    // of one chunk in one tile
  double partial_tiles = 0;   // stretches of lists that are cut, in all
  double chunk = 0;           // particles or splats at most in one
  double segment_length = 0;  // entries at most that one group draws
  double tiles = 0, pixels = 0;
  double tile_pixels = 256;
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

// Those that it knows.
std::set<std::string> known_kernels();

// The longest chain that a kernel may have: so many steps for each doubling of the largest of
// particles, entries, tiles and pixels, and of lists of a chunk as many as their segments have;
// none grows with the frame in another way. Chains of steps that are the same in all frames are
// below.
double longest_chain(const std::string& kernel, const FrameWork& work);

}  // namespace splotchcl::bench
