#include "formats/hdf5/hdf5_formats.h"

#include "formats/snapshot_format.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl {
namespace {

class Hdf5Formats : public SnapshotFormat {
 public:
  bool recognizes(const std::shared_ptr<const MappedFile>& file) const override {
    return Hdf5File::has_signature(file->data(), file->size());
  }
  std::unique_ptr<Snapshot> open(const std::filesystem::path& path,
                                 const SnapshotOptions&) const override {
    const Hdf5File file(path);
    if (is_phantom_hdf5(file)) return open_phantom_hdf5(path);
    return is_plain_hdf5(file) ? open_plain_hdf5(path) : open_gadget_hdf5(path);
  }
};

}  // namespace

const SnapshotFormat& hdf5_formats() {
  static const Hdf5Formats formats;
  return formats;
}

}  // namespace splotchcl
