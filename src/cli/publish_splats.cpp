#include "cli/publish_splats.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/unfinished_file.h"
#include "publish/nearest_splats.h"
#include "publish/splat_files.h"

namespace splotchcl::cli {
namespace {

constexpr int longest_side = 512;
constexpr double steps = 255;

Frame over_black(Frame frame) {
  frame.background = {0, 0, 0};
  frame.background_image = nullptr;
  return frame;
}

}  // namespace

Scene as_compared(Scene scene) {
  const double part =
      static_cast<double>(longest_side) / std::max(scene.image.width, scene.image.height);
  if (part < 1) {
    for (int* const side : {&scene.image.width, &scene.image.height})
      *side = std::max(1, static_cast<int>(std::lround(part * *side)));
  }
  scene.finish.bloom = 0;
  return scene;
}

void publish_splats(const std::filesystem::path& path, const Scene& scene, const Frame& frame,
                    const SnapshotInfo& snapshot, const std::vector<LightSplat>& splats,
                    std::size_t particles, FrameDrawer& drawer, Console& console) {
  console.status("drawing what the splats are to show");
  DrawnFrame drawn = drawer.draw(scene, over_black(frame), snapshot);
  const DisplayLight display = {drawn.finish.value_or(scene.finish), scene.image.gamma};
  console.status("looking for the nearest opacities");
  const NearestSplats nearest =
      nearest_splats(splats, frame, drawn.pictures.front().light, display);
  const std::string about = fmt::format(
      "{} splats for {} particles; viewers show them {:.1f} of 255 steps (rms) from the picture, "
      "{:.0f} at most",
      splats.size(), particles, steps * nearest.rms_difference, steps * nearest.largest_difference);
  const std::string text = as_splat_file(path, nearest.splats, frame, about);
  UnfinishedFile file(path);
  file.write(text.data(), text.size());
  file.finish();
  console.done(fmt::format("{}: {:.1f} MB, {}", path.string(),
                           1e-6 * static_cast<double>(text.size()), about));
}

}  // namespace splotchcl::cli
