// All that OpenVDB does, as a module that src/map/map_files.cpp loads.
#include <openvdb/openvdb.h>

#include <cmath>
#include <cstddef>
#include <exception>

#include "map/voxel_file.h"

namespace splotchcl {
namespace {

// A voxel's center is a place of the lattice.
openvdb::math::Transform::Ptr transform_of(const VoxelFile& voxels) {
  const auto& side = voxels.voxel.a;
  const auto& corner = voxels.corner.a;
  openvdb::math::Mat4d matrix = openvdb::math::Mat4d::identity();
  for (int axis = 0; axis < 3; ++axis) {
    matrix(axis, axis) = side[axis];
    matrix(3, axis) = corner[axis] + 0.5 * side[axis];
  }
  return openvdb::math::Transform::createLinearTransform(matrix);
}

// Where nothing is, nothing is stored.
openvdb::FloatGrid::Ptr grid_of(const VoxelFile& voxels) {
  openvdb::FloatGrid::Ptr grid = openvdb::FloatGrid::create(0.0F);
  openvdb::FloatGrid::Accessor places = grid->getAccessor();
  std::size_t i = 0;
  for (int z = 0; z < voxels.size[2]; ++z) {
    for (int y = 0; y < voxels.size[1]; ++y) {
      for (int x = 0; x < voxels.size[0]; ++x, ++i) {
        const float value = voxels.values[i];
        if (std::isfinite(value) && value != 0) places.setValue({x, y, z}, value);
      }
    }
  }
  grid->setTransform(transform_of(voxels));
  grid->setName(voxels.name);
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  for (const auto& [key, text] : voxels.metadata)
    grid->insertMeta(key, openvdb::StringMetadata(text));
  return grid;
}

}  // namespace
}  // namespace splotchcl

extern "C" __attribute__((visibility("default"))) void splotchcl_write_voxels(
    const splotchcl::VoxelFile& voxels, const std::string& path, std::string& problem) {
  try {
    openvdb::initialize();
    openvdb::io::File(path).write(openvdb::GridPtrVec{splotchcl::grid_of(voxels)});
  } catch (const std::exception& error) {
    problem = error.what();
  }
}
