#include "publish/splat_files.h"

namespace splotchcl {
namespace {

constexpr float constant_harmonic = 0.28209479F;  // 1 / sqrt(4 pi)

}  // namespace

std::array<float, 3> harmonic_of(const std::array<float, 3>& color) {
  std::array<float, 3> harmonic{};
  for (std::size_t channel = 0; channel < 3; ++channel)
    harmonic[channel] = (color[channel] - 0.5F) / constant_harmonic;
  return harmonic;
}

std::array<float, 3> upwards(const std::array<float, 3>& place) {
  return {place[0], -place[1], -place[2]};
}

bool is_splat_file(const std::filesystem::path& path) {
  const std::filesystem::path ending = path.extension();
  return ending == ".ply" || ending == ".glb" || ending == ".usda";
}

std::string as_splat_file(const std::filesystem::path& path, const std::vector<ViewerSplat>& splats,
                          const Frame& frame, const std::string& comment) {
  if (path.extension() == ".ply") return as_ply(splats, comment);
  return path.extension() == ".glb" ? as_glb(splats, frame, comment) : as_usda(splats, comment);
}

}  // namespace splotchcl
