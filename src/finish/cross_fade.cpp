#include "finish/cross_fade.h"

#include <filesystem>
#include <string>
#include <vector>

#include "finish/tone.h"
#include "splotchcl/error.h"
#include "splotchcl/scene_file.h"

namespace splotchcl {

void mix(Image& image, const Image& other, double amount) {
  const auto part = static_cast<float>(amount);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = (1 - part) * image.pixels[i] + part * other.pixels[i];
}

void fade_to_color(Image& image, const FinishSettings& finish, double gamma) {
  if (finish.fade == 0) return;
  const auto part = static_cast<float>(finish.fade);
  const std::array<float, 3> light = light_of(finish.fade_color, gamma);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const float target = i % 4 == 3 ? 1 : light[i % 4];
    image.pixels[i] = (1 - part) * image.pixels[i] + part * target;
  }
}

namespace {

bool is_same_run(const SequenceSettings& a, const SequenceSettings& b) {
  return a.is_set() && a.snapshots == b.snapshots && a.pattern == b.pattern;
}

}  // namespace

std::optional<Scene> cross_fade_scene(const Scene& scene) {
  const CrossFade& fade = scene.finish.cross_fade;
  if (fade.scene.empty() || fade.amount == 0) return std::nullopt;
  Scene other = read_scene_file(fade.scene);
  if (!other.finish.cross_fade.scene.empty()) {
    throw UsageError("key finish.cross_fade.scene: found " + fade.scene +
                     ", which fades to another scene itself, expected one that does not");
  }
  other.image.width = scene.image.width;
  other.image.height = scene.image.height;
  other.image.gamma = scene.image.gamma;
  if (!other.camera) other.camera = scene.camera;
  if (is_same_run(other.time, scene.time)) other.time.index = scene.time.index;
  if (!other.finish.frame) other.finish.frame = scene.finish.frame;
  const std::vector<PictureSize> own = picture_sizes(scene, scene.image.width, scene.image.height);
  const std::vector<PictureSize> others =
      picture_sizes(other, other.image.width, other.image.height);
  bool is_same = own.size() == others.size();
  for (std::size_t i = 0; is_same && i < own.size(); ++i) {
    is_same = own[i].suffix == others[i].suffix && own[i].width == others[i].width &&
              own[i].height == others[i].height;
  }
  if (!is_same) {
    throw UsageError("key finish.cross_fade.scene: found " + fade.scene +
                     ", whose pictures are others (stereo, projection), expected the same ones");
  }
  return other;
}

void check_cross_fade(const Scene& scene) {
  const std::string& file = scene.finish.cross_fade.scene;
  std::error_code error;
  if (!file.empty() && !std::filesystem::is_regular_file(file, error)) {
    throw UsageError("key finish.cross_fade.scene: found no file " + file +
                     ", expected a scene file");
  }
  (void)cross_fade_scene(scene);
}

}  // namespace splotchcl
