#include <algorithm>
#include <optional>
#include <utility>

#include "finish/finish_picture.h"
#include "finish/joined_pictures.h"
#include "finish/tone.h"
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

Image cut_out(const Image& whole, const Rectangle& part) {
  Image image(part.width, part.height);
  for (int row = 0; row < part.height; ++row) {
    const float* const first = whole.at(part.x, part.y + row);
    std::copy(first, first + 4 * static_cast<std::size_t>(part.width), image.at(0, row));
  }
  return image;
}

// All views of a scene on the way to its pictures: drawn one after the other, and finished once
// all of them have shown how much light there is, where that is asked for.
class Views {
 public:
  Views(const Scene& scene, const Frame& frame, const SnapshotInfo& snapshot)
      : scene_(scene), frame_(frame), places_(view_places(scene)) {
    for (const ViewPlace& place : places_) {
      ViewPlace between_eyes = place;
      between_eyes.eye.reset();
      finishes_.emplace_back(scene, frame_of_view(scene, frame, between_eyes), snapshot, place.eye);
    }
  }

  DrawnPictures draw(const DrawFrame& draw) const {
    DrawnPictures drawn;
    drawn.finish = scene_.finish;
    std::vector<Image> images;
    if (has_open_tone(scene_.finish)) {
      LightHistogram light;
      for (const ViewPlace& place : places_)
        images.push_back(draw_with_light(place, draw, light));
      drawn.finish = with_any_tone(scene_.finish, light);
      drawn.is_black = !with_tone_of(scene_.finish, light);
    }
    const std::vector<PictureSize> sizes =
        picture_sizes(scene_, frame_.crop.width, frame_.crop.height);
    for (const PictureSize& size : sizes)
      drawn.pictures.push_back(
          {size.suffix,
           Image(),
           {frame_.crop.x, frame_.crop.y, frame_.crop.width, frame_.crop.height}});
    const bool overlaps = scene_.stereo && is_anaglyph(scene_.stereo->layout);
    std::vector<Picture> of_right_eye;
    if (overlaps) of_right_eye = drawn.pictures;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      Image image =
          images.empty() ? draw(frame_of_view(scene_, frame_, places_[i])) : std::move(images[i]);
      finishes_[i].apply(image, drawn.finish, draw);
      const bool is_over = overlaps && places_[i].eye == Eye::right;
      put(std::move(image), places_[i], sizes, is_over ? of_right_eye : drawn.pictures);
    }
    for (std::size_t i = 0; i < of_right_eye.size(); ++i) {
      Image& left = drawn.pictures[i].image;
      left = anaglyph(left, of_right_eye[i].image, scene_.stereo->layout, scene_.image.gamma);
    }
    return drawn;
  }

 private:
  // A crop has the whole picture's exposure.
  Image draw_with_light(const ViewPlace& place, const DrawFrame& draw,
                        LightHistogram& light) const {
    Frame view = frame_of_view(scene_, frame_, place);
    view.crop = {0, 0, view.width, view.height};
    Image image = draw(view);
    light.add(image);
    const bool is_whole = frame_.crop.width == view.width && frame_.crop.height == view.height;
    return is_whole ? image : cut_out(image, frame_.crop);
  }

  // A view that is all of its picture becomes it.
  static void put(Image image, const ViewPlace& place, const std::vector<PictureSize>& sizes,
                  std::vector<Picture>& pictures) {
    std::size_t i = 0;
    while (pictures[i].suffix != place.suffix)
      ++i;
    Image& picture = pictures[i].image;
    if (image.width == sizes[i].width && image.height == sizes[i].height) {
      picture = std::move(image);
      return;
    }
    if (picture.pixels.empty()) picture = Image(sizes[i].width, sizes[i].height);
    copy_into(image, place.column * image.width, place.row * image.height, picture);
  }

  const Scene& scene_;
  const Frame& frame_;
  std::vector<ViewPlace> places_;
  std::vector<PictureFinish> finishes_;
};

}  // namespace

DrawnPictures draw_pictures(const Scene& scene, const Frame& frame, const SnapshotInfo& snapshot,
                            const DrawFrame& draw, std::vector<std::string>& notes,
                            OtherScenes& other_scenes) {
  const std::optional<Scene> other = cross_fade_scene(scene);
  const auto& [file, amount] = scene.finish.cross_fade;
  DrawnPictures drawn;
  drawn.finish = scene.finish;
  if (other && amount == 1) {
    drawn.pictures = other_scenes.draw(file, *other, frame.crop, draw, notes);
  } else {
    drawn = Views(scene, frame, snapshot).draw(draw);
  }
  std::vector<Picture>& pictures = drawn.pictures;
  if (other && amount < 1) {
    const std::vector<Picture> others = other_scenes.draw(file, *other, frame.crop, draw, notes);
    for (std::size_t i = 0; i < pictures.size(); ++i)
      mix(pictures[i].image, others[i].image, amount);
  }
  for (Picture& picture : pictures)
    fade_to_color(picture.image, scene.finish, scene.image.gamma);
  return drawn;
}

std::vector<Picture> draw_pictures(const Scene& scene, const Frame& frame,
                                   const SnapshotInfo& snapshot, const DrawFrame& draw,
                                   std::vector<std::string>& notes) {
  OtherScenes others;
  return draw_pictures(scene, frame, snapshot, draw, notes, others).pictures;
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
