#include "splotchcl/picture.h"

namespace splotchcl {

std::vector<FrameView> views_of(const Scene&, const Frame& frame) {
  return {{"", frame}};
}

std::vector<PictureSize> picture_sizes(const Scene&, int view_width, int view_height) {
  return {{"", view_width, view_height}};
}

std::vector<Picture> draw_pictures(const Scene& scene, const Frame& frame, const DrawFrame& draw) {
  std::vector<Picture> pictures;
  for (const FrameView& view : views_of(scene, frame)) {
    pictures.push_back({view.suffix, draw(view.frame)});
  }
  return pictures;
}

std::vector<Picture> draw_pictures(const Scene& scene, const Snapshot& snapshot,
                                   const DrawFrame& draw, std::vector<std::string>& notes) {
  return draw_pictures(scene, load_frame(scene, snapshot, notes), draw);
}

std::filesystem::path picture_path(const std::filesystem::path& output, const std::string& suffix) {
  const std::filesystem::path name = output.stem().string() + suffix + output.extension().string();
  return output.parent_path() / name;
}

}  // namespace splotchcl
