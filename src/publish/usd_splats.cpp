#include <fmt/format.h>

#include <functional>
#include <iterator>

#include "publish/splat_files.h"

namespace splotchcl {
namespace {

using Put = std::function<void(std::string&, const ViewerSplat&)>;

void put_triple(std::string& file, const std::array<float, 3>& numbers) {
  fmt::format_to(std::back_inserter(file), "({}, {}, {})", numbers[0], numbers[1], numbers[2]);
}

void add_array(std::string& file, const char* name, const std::vector<ViewerSplat>& splats,
               const Put& put) {
  file += fmt::format("    {} = [", name);
  const char* comma = "";
  for (const ViewerSplat& splat : splats) {
    file += comma;
    put(file, splat);
    comma = ", ";
  }
  file += "]\n";
}

}  // namespace

std::string as_usda(const std::vector<ViewerSplat>& splats, const std::string& comment) {
  std::string file = "#usda 1.0\n(\n    \"Made by splotchcl: " + comment +
                     "\"\n    defaultPrim = \"Splats\"\n    upAxis = \"Y\"\n)\n\n"
                     "def ParticleField3DGaussianSplat \"Splats\"\n{\n"
                     "    uniform token projectionModeHint = \"perspective\"\n"
                     "    uniform token sortingModeHint = \"cameraDistance\"\n"
                     "    uniform int radiance:sphericalHarmonicsDegree = 0\n";
  add_array(file, "point3f[] positions", splats, [](std::string& text, const ViewerSplat& splat) {
    put_triple(text, upwards(splat.place));
  });
  add_array(file, "quatf[] orientations", splats,
            [](std::string& text, const ViewerSplat&) { text += "(1, 0, 0, 0)"; });
  add_array(file, "float3[] scales", splats, [](std::string& text, const ViewerSplat& splat) {
    put_triple(text, {splat.deviation, splat.deviation, splat.deviation});
  });
  add_array(file, "float[] opacities", splats, [](std::string& text, const ViewerSplat& splat) {
    fmt::format_to(std::back_inserter(text), "{}", splat.opacity);
  });
  add_array(file, "float3[] radiance:sphericalHarmonicsCoefficients", splats,
            [](std::string& text, const ViewerSplat& splat) {
              put_triple(text, harmonic_of(splat.color));
            });
  return file + "}\n";
}

}  // namespace splotchcl
