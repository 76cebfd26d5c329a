#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "splotchcl/vector.h"

namespace splotchcl {

// A cube of voxels as OpenVDB has it.
struct VoxelFile {
  std::array<int, 3> size = {1, 1, 1};
  std::vector<float> values;  // x fastest, then y, then z; not a number: nothing is there
  Vec3 corner = {{0, 0, 0}};  // the lower one, in the map's lengths
  Vec3 voxel = {{1, 1, 1}};   // sides
  std::string name;           // of the grid
  std::map<std::string, std::string> metadata;
};

// OpenVDB, which few systems have, lies in a module of its own (src/openvdb), loaded when the first
// such file is asked for. Throws DataError where it is missing.
void require_voxel_files();
// Throws DataError where the file cannot be written.
void write_voxel_file(const std::filesystem::path& path, const VoxelFile& voxels);

// What the module exports. `problem` becomes what went wrong.
using WriteVoxels = void(const VoxelFile& voxels, const std::string& path, std::string& problem);
inline constexpr char voxel_writer_entry[] = "splotchcl_write_voxels";

}  // namespace splotchcl
