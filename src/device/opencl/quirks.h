#pragma once

#include "device/opencl/opencl.h"

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

}  // namespace splotchcl
