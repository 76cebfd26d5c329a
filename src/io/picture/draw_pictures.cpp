#include <memory>
#include <optional>

#include "io/finish/cross_fade.h"
#include "io/finish/fade.h"
#include "io/finish/finish_picture.h"
#include "splotchcl/picture.h"
#include "splotchcl/sequence.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

std::vector<FrameView> views_of(const Scene&, const Frame& frame) {
  return {{"", frame}};
}

std::vector<PictureSize> picture_sizes(const Scene&, int view_width, int view_height) {
  return {{"", view_width, view_height}};
}

namespace {

// The scene's own pictures, before anything is faded.
std::vector<Picture> draw_views(const Scene& scene, const Frame& frame,
                                const SnapshotInfo& snapshot, const DrawFrame& draw) {
  std::vector<Picture> pictures;
  for (const FrameView& view : views_of(scene, frame)) {
    const PictureFinish finish(scene, view.frame, snapshot);
    pictures.push_back({view.suffix, draw(view.frame)});
    finish.apply(pictures.back().image, draw);
  }
  return pictures;
}

// The pictures of the scene that this one fades to.
std::vector<Picture> draw_other(const Scene& other, const Rectangle& crop, const DrawFrame& draw,
                                std::vector<std::string>& notes) {
  const std::shared_ptr<const Snapshot> snapshot = SnapshotSource().at(other);
  Frame frame = load_frame(other, *snapshot, notes);
  frame.crop = crop;
  return draw_pictures(other, frame, snapshot->info(), draw, notes);
}

}  // namespace

std::vector<Picture> draw_pictures(const Scene& scene, const Frame& frame,
                                   const SnapshotInfo& snapshot, const DrawFrame& draw,
                                   std::vector<std::string>& notes) {
  const std::optional<Scene> other = cross_fade_scene(scene);
  const double amount = scene.finish.cross_fade.amount;
  std::vector<Picture> pictures = other && amount == 1 ? draw_other(*other, frame.crop, draw, notes)
                                                       : draw_views(scene, frame, snapshot, draw);
  if (other && amount < 1) {
    const std::vector<Picture> others = draw_other(*other, frame.crop, draw, notes);
    for (std::size_t i = 0; i < pictures.size(); ++i)
      mix(pictures[i].image, others[i].image, amount);
  }
  for (Picture& picture : pictures)
    fade_to_color(picture.image, scene.finish, scene.image.gamma);
  return pictures;
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
