#include "map/voxel_file.h"

#include <dlfcn.h>

#include "modules/module_file.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr char module_name[] = "libsplotchcl_openvdb.so";

// Never unloaded, as src/image/image_library.cpp says of others.
WriteVoxels* load() {
  void* const module = dlopen(module_file(module_name).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) {
    throw DataError(std::string(".vdb files need ") + module_name + ", which cannot be loaded (" +
                    dlerror() +
                    "); it is built where OpenVDB is installed; write .npy or .hdf5 instead");
  }
  void* const entry = dlsym(module, voxel_writer_entry);
  if (entry == nullptr) {
    throw DataError(std::string(module_name) + " is not of this version of splotchcl (" +
                    dlerror() + "); install both again");
  }
  return reinterpret_cast<WriteVoxels*>(entry);
}

WriteVoxels& voxel_writer() {
  static WriteVoxels* const writer = load();
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
