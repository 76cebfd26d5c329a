#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "publish/viewer_splats.h"

namespace splotchcl {

// Files of splats that viewers and other programs read. Each is whole in memory.
//   .ply   the layout of 3D Gaussian splatting: x right, y down, z forward
//   .glb   binary glTF 2.0 with KHR_gaussian_splatting, and the frame's camera: y is up
//   .usda  OpenUSD's ParticleField3DGaussianSplat (from 26.03 on): y is up
// The look-at point is the origin; half of the picture's width there is 1.
// `comment`, a line of ASCII, stands in the file.
std::string as_ply(const std::vector<ViewerSplat>& splats, const std::string& comment);
std::string as_glb(const std::vector<ViewerSplat>& splats, const Frame& frame,
                   const std::string& comment);
std::string as_usda(const std::vector<ViewerSplat>& splats, const std::string& comment);

// Whether a file's ending is one of these.
bool is_splat_file(const std::filesystem::path& path);

// As the path's ending says.
std::string as_splat_file(const std::filesystem::path& path, const std::vector<ViewerSplat>& splats,
                          const Frame& frame, const std::string& comment);

}  // namespace splotchcl
