#pragma once

#include <cstdint>
#include <string>

#include "device/opencl/opencl.h"
#include "device/opencl/program_text.h"

namespace splotchcl {

// What an implementation of OpenCL does unlike others, as far as this program acts on it
// (docs/dev/gpu.md, "Implementations").
struct Quirks {
  // It reads 16000 lines of declarations before each program: programs bring their own.
  bool reads_declarations = false;
  // It compiles a kernel's body three times, and what the kernel calls once.
  bool compiles_bodies_again = false;
  bool has_prefetch = false;  // clang's builtin
  bool has_ballot = false;    // NVIDIA's vote of a warp
  // It fails where several queues run one kernel at the same time: a process has one.
  bool needs_one_queue = false;
  // It uses the host's memory at any address, and a processor's large pages pay.
  bool takes_large_pages = false;
  // Compiled programs of one process serve another on the same machine.
  bool shares_binaries = false;
};

Quirks quirks_of(const compute::device& device);

// What differs between devices, decided by their type and by the shape of the kernels, for GPUs
// also by their memory, so that the same device always does the same sums in the same order.
struct DeviceTraits {
  bool is_gpu = false;
  bool shares_host_memory = false;  // buffers may lie in the caller's own memory
  bool large_pages = false;         // working memory is the host's, on large pages (buffer_pool.h)
  bool rows = true;                 // the shape: eight lanes, rows; not work-groups
  bool rows_of_16 = false;          // registers hold sixteen floats
  bool sorts_in_groups = false;     // else by work-items that walk blocks
  bool clears_in_pieces = false;    // memory, by all threads; else by the driver
  // A slab is a launch of each stage, too small for a GPU to be busy: it draws as fast in order
  // (docs/dev/gpu.md).
  bool draws_slabs = true;
  bool double_numbers = false;          // cl_khr_fp64
  bool native_exp2 = false;             // serves as the polynomial would (device_context.h)
  std::uint64_t largest_buffer = 0;     // bytes
  std::uint64_t gpu_memory = 0;         // bytes, free or not; 0: no GPU
  std::uint32_t threads = 1;            // only memory follows from them
  std::uint32_t project_block = 0;      // particles per work-item of a projection, or per group
  std::uint32_t interpolate_block = 0;  // particles per work-item that interpolates columns
  std::uint32_t chunk_blocks = 0;       // such blocks per chunk of a sum
  std::uint32_t leaf_chunks = 0;        // such chunks per leaf of a sum (chunks.h)
  std::uint32_t sorted_chunk = 0;       // splats per chunk where they are sorted
  std::uint32_t bin_blocks = 0;         // blocks that a chunk's splats are binned in, in order
  std::uint32_t sort_blocks = 0;        // blocks of the radix sort
  std::uint32_t segment_length = 0;     // entries of a tile's list per work-item
  std::uint64_t list_capacity = 0;      // entries of all lists of a band of the picture

  std::uint32_t chunk_length() const { return project_block * chunk_blocks; }
  Choices lanes() const { return lanes_of(rows); }  // of programs that do not depend on the frame
  std::string shape_name() const {
    return std::string(rows ? "rows" : "groups") + (rows_of_16 ? " of 16" : "");
  }
  // The other shape, with all sizes that go with it, if it is not this one.
  void choose_shape(bool in_rows);

 private:
  void take_sizes_of_rows();
  void take_sizes_of_groups();
};

DeviceTraits traits_of(const compute::device& device);

}  // namespace splotchcl
