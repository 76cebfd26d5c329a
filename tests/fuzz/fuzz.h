#pragma once

#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include "formats/snapshot_format.h"
#include "fuzz/targets.h"
#include "splotchcl/error.h"
#include "splotchcl/snapshot_file.h"

// libFuzzer calls LLVMFuzzerTestOneInput with bytes of its own making. A finding is a crash, a
// report of a sanitizer, an exception that is no Error of ours, or more memory than the limit
// that scripts/fuzz sets.
namespace splotchcl::fuzz {

// A file of its own for this process, in memory where the system has such a place.
class ScratchFile {
 public:
  ScratchFile() {
    const std::filesystem::path memory = "/dev/shm";
    const std::filesystem::path folder =
        (std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path()) /
        ("splotchcl-fuzz-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    path_ = folder / "input";
  }
  ~ScratchFile() {
    std::error_code ignored;
    std::filesystem::remove_all(path_.parent_path(), ignored);
  }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline const std::filesystem::path& scratch_file() {
  static const ScratchFile file;
  return file.path();
}

inline void write_scratch(const std::uint8_t* data, std::size_t size) {
  std::ofstream file(scratch_file(), std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
}

// Every field of every type, and the identifiers.
inline void read_all(const Snapshot& snapshot) {
  for (const ParticleTypeInfo& type : snapshot.info().types) {
    for (const FieldInfo& field : type.fields) {
      try {
        const Column column = snapshot.read(type.type, field.name);
        // The columns must be as long as is promised, to the last value.
        const std::size_t size =
            static_cast<std::size_t>(type.count) * static_cast<unsigned>(field.values_per_particle);
        if (column.is_array() && column.size() != size) std::abort();
        volatile float last = column.is_array() && size > 0 ? column[size - 1] : 0;
        static_cast<void>(last);
      } catch (const Error&) {
        // refused
      }
    }
    try {
      if (snapshot.read_ids(type.type).size() != type.count) std::abort();
    } catch (const Error&) {
      // none, or refused
    }
  }
}

// Opens the scratch file, or a place in it, with one format, and reads all.
inline void read_as(const SnapshotFormat& format, const SnapshotOptions& options = {},
                    const std::string& place = "") {
  try {
    if (!format.recognizes(MappedFile::open(scratch_file()))) return;
    const std::filesystem::path& file = scratch_file();
    read_all(*format.open(place.empty() ? file : file / place, options));
  } catch (const Error&) {
    // refused
  }
}

}  // namespace splotchcl::fuzz
