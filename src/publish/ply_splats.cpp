#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "publish/little_endian.h"
#include "publish/splat_files.h"

namespace splotchcl {
namespace {

constexpr float least_opacity = 1e-6F;

std::string header_of(std::size_t count, const std::string& comment) {
  std::string header = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment made by splotchcl: {}\nelement vertex {}\n",
      comment, count);
  for (const char* const name :
       {"x", "y", "z", "nx", "ny", "nz", "f_dc_0", "f_dc_1", "f_dc_2", "opacity", "scale_0",
        "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"})
    header += fmt::format("property float {}\n", name);
  return header + "end_header\n";
}

// Readers take it through the logistic function.
float logit(float opacity) {
  const float inside = std::clamp(opacity, least_opacity, 1 - least_opacity);
  return std::log(inside / (1 - inside));
}

}  // namespace

std::string as_ply(const std::vector<ViewerSplat>& splats, const std::string& comment) {
  std::string file = header_of(splats.size(), comment);
  for (const ViewerSplat& splat : splats) {
    const float scale = std::log(splat.deviation);
    append(file, splat.place);
    append(file, std::array<float, 3>{});  // normals, which nothing uses
    append(file, harmonic_of(splat.color));
    append(file, std::array<float, 1>{logit(splat.opacity)});
    append(file, std::array<float, 3>{scale, scale, scale});
    append(file, std::array<float, 4>{1, 0, 0, 0});
  }
  return file;
}

}  // namespace splotchcl
