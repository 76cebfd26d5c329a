#include <algorithm>
#include <optional>

#include "finish/cross_fade.h"
#include "finish/fade.h"
#include "finish/finish_picture.h"
#include "pictures/other_scenes.h"
#include "splotchcl/load.h"
#include "splotchcl/picture.h"
#include "splotchcl/snapshot.h"
#include "views/views.h"

namespace splotchcl {
namespace {

void copy_into(const Image& part, int x, int y, Image& whole) {
  for (int row = 0; row < part.height; ++row) {
    const float* const first = part.at(0, row);
    std::copy(first, first + 4 * static_cast<std::size_t>(part.width), whole.at(x, y + row));
  }
}

// The scene's own pictures, before anything is faded.
std::vector<Picture> draw_views(const Scene& scene, const Frame& frame,
                                const SnapshotInfo& snapshot, const DrawFrame& draw) {
  std::vector<Picture> pictures;
  for (const PictureSize& size : picture_sizes(scene, frame.crop.width, frame.crop.height)) {
    pictures.push_back({size.suffix, Image(size.width, size.height)});
  }
  for (const ViewPlace& place : view_places(scene)) {
    ViewPlace between_eyes = place;
    between_eyes.eye.reset();
    const PictureFinish finish(scene, frame_of_view(scene, frame, between_eyes), snapshot,
                               place.eye);
    Image image = draw(frame_of_view(scene, frame, place));
    finish.apply(image, draw);
    const auto picture = std::find_if(pictures.begin(), pictures.end(),
                                      [&](const Picture& p) { return p.suffix == place.suffix; });
    copy_into(image, place.column * image.width, place.row * image.height, picture->image);
  }
  return pictures;
}

}  // namespace

std::vector<Picture> draw_pictures(const Scene& scene, const Frame& frame,
                                   const SnapshotInfo& snapshot, const DrawFrame& draw,
                                   std::vector<std::string>& notes, OtherScenes& other_scenes) {
  const std::optional<Scene> other = cross_fade_scene(scene);
  const auto& [file, amount] = scene.finish.cross_fade;
  std::vector<Picture> pictures = other && amount == 1
                                      ? other_scenes.draw(file, *other, frame.crop, draw, notes)
                                      : draw_views(scene, frame, snapshot, draw);
  if (other && amount < 1) {
    const std::vector<Picture> others = other_scenes.draw(file, *other, frame.crop, draw, notes);
    for (std::size_t i = 0; i < pictures.size(); ++i)
      mix(pictures[i].image, others[i].image, amount);
  }
  for (Picture& picture : pictures)
    fade_to_color(picture.image, scene.finish, scene.image.gamma);
  return pictures;
}

std::vector<Picture> draw_pictures(const Scene& scene, const Frame& frame,
                                   const SnapshotInfo& snapshot, const DrawFrame& draw,
                                   std::vector<std::string>& notes) {
  OtherScenes others;
  return draw_pictures(scene, frame, snapshot, draw, notes, others);
}

std::vector<Picture> draw_pictures(const Scene& scene, const Snapshot& snapshot,
                                   const DrawFrame& draw, std::vector<std::string>& notes) {
  const Frame frame = load_frame(scene, snapshot, notes);
  return draw_pictures(scene, frame, snapshot.info(), draw, notes);
}

std::filesystem::path picture_path(const std::filesystem::path& output, const std::string& suffix) {
  const std::filesystem::path name = output.stem().string() + suffix + output.extension().string();
  return output.parent_path() / name;
}

}  // namespace splotchcl
