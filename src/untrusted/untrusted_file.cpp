#include "splotchcl/untrusted_file.h"

#include <string>

#include "common/guards.h"
#include "splotchcl/error.h"
#include "splotchcl/image_file.h"
#include "splotchcl/snapshot.h"
#include "untrusted/child_process.h"

namespace splotchcl {

LiveFiles::LiveFiles() {
  survive_cut_files();
  cut_before_ = cut_file_count();
}

void LiveFiles::require_whole() const {
  if (cut_file_count() == cut_before_) return;
  throw DataError(std::string(last_cut_file()) +
                  ": became shorter while it was read; wait until it is completely written and try "
                  "again");
}

namespace {

void read_everything(const Snapshot& snapshot) {
  for (const ParticleTypeInfo& type : snapshot.info().types) {
    for (const FieldInfo& field : type.fields) {
      // Mapped files are read when they are looked at.
      const Column column = snapshot.read(type.type, field.name);
      volatile float seen = 0;
      for (std::size_t i = 0; i < column.size(); ++i)
        seen = column[i];
      static_cast<void>(seen);
    }
    try {
      static_cast<void>(snapshot.read_ids(type.type));
    } catch (const Error&) {
      // A file need not have any, and a scene that asks for them is told what is wrong.
    }
  }
}

}  // namespace

void check_untrusted_snapshot(const std::filesystem::path& path, const SnapshotOptions& options,
                              const ChildLimits& limits) {
  run_in_child(
      path.string(), [&] { read_everything(*open_snapshot(path, options)); }, limits);
}

void check_untrusted_image(const std::filesystem::path& path, const ChildLimits& limits) {
  run_in_child(
      path.string(), [&] { static_cast<void>(read_image(path)); }, limits);
}

}  // namespace splotchcl
