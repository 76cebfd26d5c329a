#include "map/voxel_file.h"

#include "modules/module_file.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

WriteVoxels& voxel_writer() {
  static auto* const writer = reinterpret_cast<WriteVoxels*>(
      module_entry("libsplotchcl_openvdb.so", voxel_writer_entry, ".vdb files need",
                   "it is built where OpenVDB is installed; write .npy or .hdf5 instead"));
  return *writer;
}

}  // namespace

void require_voxel_files() {
  (void)voxel_writer();
}

void write_voxel_file(const std::filesystem::path& path, const VoxelFile& voxels) {
  std::string problem;
  voxel_writer()(voxels, path.string(), problem);
  if (!problem.empty()) throw DataError(path.string() + ": cannot be written: " + problem);
}

}  // namespace splotchcl
