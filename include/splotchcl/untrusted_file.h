#pragma once

#include <cstdint>
#include <filesystem>

#include "splotchcl/snapshot_file.h"

// Files from strangers. Readers check what they read, but HDF5 and the libraries of picture formats
// do not: some damaged files make them crash, run without end or claim all memory. The program ends
// then, with a line; a program that uses the library may not want to. Here a child process reads
// the whole file first, as it will be read, and what becomes of the child becomes an exception.
// That takes as long as reading itself. Call it where no other thread reads HDF5 files: a child has
// only the thread that called. POSIX's fork(); open files and devices of the caller are not
// touched.
namespace splotchcl {

// What a child process may take.
struct ChildLimits {
  int seconds = 600;                                    // >= 1, of time
  std::uint64_t memory_bytes = std::uint64_t{4} << 30;  // beyond what the caller has; 0: any
};

// Opens the snapshot and reads every field. Throws what open_snapshot throws, and DataError where
// the child crashes or needs more than its limits.
void check_untrusted_snapshot(const std::filesystem::path& path,
                              const SnapshotOptions& options = {}, const ChildLimits& limits = {});

// Reads the picture. Throws what read_image throws, and DataError likewise.
void check_untrusted_image(const std::filesystem::path& path, const ChildLimits& limits = {});

// Files that other programs write meanwhile. Snapshots are mapped, not copied: who looks at the end
// of one that has become shorter gets the signal SIGBUS, wherever that may be, also in memory that
// was read long before. While one of these lives, or has lived, the process goes on: what is no
// longer there reads as zeros from then on, and signals of other memory go where they went before.
// Make it after devices have been opened, since some compilers of kernels take the signal.
class LiveFiles {
 public:
  LiveFiles();
  // Throws DataError, with its name, where a file has become shorter since: what was read or drawn
  // of it is to be thrown away. Reading says so by itself; this is for what was drawn.
  void require_whole() const;

 private:
  std::uint64_t cut_before_ = 0;
};

}  // namespace splotchcl
