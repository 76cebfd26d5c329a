#pragma once

#include <string>
#include <vector>

// The least that each stage of a frame could take on this machine, from what it has to move and
// to compute and from what the machine was just seen to do. It tells what forbids a goal.
//
// Bytes: every array that one stage hands to another is written once and read once, by the kernels
// for processors. A byte written counts twice, since its line of the cache is read first
// (bandwidth.h). Not counted, so that a floor stays one: counts and tables, the bands of coarse
// grids, what a stage keeps for itself, planes that are read and written once more for every chunk,
// and all but the position of a particle that is not visible. Sorting is the exception: its passes
// are those of this radix sort.
//
// Operations: of compositing alone, the multiplications with an addition of the pixels themselves:
// three for a pixel of a splat in sums, and nine in layers, which take each channel's light and
// opacity. What splats take before that, their shapes, is not counted, and no stage but this one.
// Lists of tiles that turn opaque count in full.
namespace splotchcl::bench {

// Entries of tiles' lists, and the row parts, eight pixels of a row each, that lie within their
// splats.
struct ListWork {
  double entries = 0, row_parts = 0;
  double patches = 0;  // that wide discs reach into
};

// Pixels of a tile that stay in registers while the wide splats of a sum are added to them.
struct PatchSize {
  double width = 0, height = 0;
};

// What a frame gave its stages to do. Bytes are those of one.
struct FrameCounts {
  bool is_ordered = false;
  bool is_collected = true;   // for the check after drawing, where there are errors of splats
  int slabs = 0;              // that are laid at most
  double particles = 0;       // in its components
  double particle_bytes = 0;  // of all columns, the mean
  double splats = 0;          // visible
  double splat_bytes = 0;
  ListWork layered;  // in order
  ListWork summed;   // of sums, and of the coarse grids of slabs
  PatchSize patch;   // of sums of a kernel that is cut, on a processor
  double entry_bytes = 0;
  double key_bytes = 0;  // of a splat's key, its end included
  double pixels = 0;
  double planes = 0;  // floats of a pixel
  double chunks = 0;  // that pass through one after the other
  double entries() const { return layered.entries + summed.entries; }
};

// Of a chunk's entries: what of its arrays a cache may hold at best.
double chunk_bytes(const FrameCounts& counts);

// What the machine was seen to do just now, on all its threads.
struct MachineRates {
  double memory_bandwidth = 0;  // bytes/s, through arrays far larger than caches
  double chunk_bandwidth = 0;   // bytes/s, through arrays of chunk_bytes()
  double multiply_adds = 0;     // of floats, a second
};

double multiply_adds_of(const FrameCounts& counts);

struct StageFloor {
  std::string stage;
  double frame_bytes = 0;  // of arrays that hold all of the frame
  double chunk_bytes = 0;  // of arrays that hold a chunk
  double byte_seconds = 0;
  double operation_seconds = 0;  // 0: no floor is known
  double seconds() const;        // the larger one
};

// In the order in which stages run; those that a frame does not need are left out.
std::vector<StageFloor> floors_of(const FrameCounts& counts, const MachineRates& rates);

}  // namespace splotchcl::bench
