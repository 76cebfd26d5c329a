#include <algorithm>
#include <optional>
#include <utility>

#include "finish/effects.h"
#include "finish/finish_picture.h"
#include "finish/tone.h"
#include "pictures/other_scenes.h"
#include "scene/views.h"
#include "splotchcl/load.h"
#include "splotchcl/picture.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

void OtherScenes::decide(const Scene& scene) {
  const CrossFade& fade = scene.finish.cross_fade;
  if (fade.scene.empty() || fade.amount == 0) return;
  OtherScene& other = by_file_[fade.scene];
  if (other.decided) return;
  const Scene open = *cross_fade_scene(scene);
  std::vector<std::string> ignored;  // told when it is drawn
  other.decided = fixed_scene(splotchcl::decide(open, *other.snapshots.at(open), ignored));
}

bool OtherScenes::lacks_tone(const Scene& scene) const {
  const std::optional<Scene> other = cross_fade_scene(scene);
  if (!other || !has_open_tone(other->finish)) return false;
  const auto known = by_file_.find(scene.finish.cross_fade.scene);
  return known == by_file_.end() || !known->second.tone;
}

std::vector<Picture> OtherScenes::draw(const std::string& file, Scene other, const Rectangle& crop,
                                       const DrawFrame& draw, PictureLight light,
                                       const KeepsPromise& keeps_promise,
                                       std::vector<std::string>& notes,
                                       const std::vector<Moment>& moments) {
  OtherScene& known = by_file_[file];
  if (known.decided) other.components = known.decided->components;
  std::vector<Moment> of_other;
  for (const Moment& moment : moments) {
    Scene scene = cross_fade_scene(moment.scene).value_or(other);
    scene.components = other.components;
    of_other.push_back({scene, [&known, scene] { return known.snapshots.at(scene); }});
  }
  const bool is_open = has_open_tone(other.finish);
  if (is_open && known.tone) take_tone(*known.tone, other.finish);
  const std::shared_ptr<const Snapshot> snapshot = known.snapshots.at(other);
  Frame frame = load_frame(other, *snapshot, notes);
  OtherScenes none;  // it fades to no third
  frame.crop = crop;
  DrawnPictures drawn = draw_pictures(other, frame, snapshot->info(), draw, notes, none, light,
                                      keeps_promise, of_other);
  if (is_open && !known.tone && !drawn.is_black) known.tone = drawn.finish;
  return std::move(drawn.pictures);
}

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

void scale(float factor, Image& image) {
  for (float& value : image.pixels)
    value *= factor;
}

void add(std::vector<Image> images, std::vector<Image>& sums) {
  if (sums.empty()) {
    sums = std::move(images);
    return;
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    for (std::size_t k = 0; k < sums[i].pixels.size(); ++k)
      sums[i].pixels[k] += images[i].pixels[k];
  }
}

bool is_anaglyph(const Scene& scene) {
  return scene.stereo && is_anaglyph(scene.stereo->layout);
}

// All views of a scene on the way to its pictures: drawn one after the other, and finished once
// all of them have shown how much light there is, where that is asked for.
class Views {
 public:
  Views(const Scene& scene, const Frame& frame, const SnapshotInfo& snapshot, PictureLight light,
        const std::vector<Moment>& moments)
      : scene_(scene),
        frame_(frame),
        moments_(moments),
        is_shown_(light != PictureLight::drawn),
        keeps_light_(light != PictureLight::shown),
        places_(view_places(scene)) {
    for (const ViewPlace& place : places_) {
      ViewPlace between_eyes = place;
      between_eyes.eye.reset();
      finishes_.emplace_back(scene, frame_of_view(scene, frame, between_eyes), snapshot, place.eye);
    }
  }

  DrawnPictures draw(const DrawFrame& draw_alike, const KeepsPromise& keeps_promise,
                     const LooseDrawing& loose) const {
    DrawnPictures drawn;
    drawn.finish = scene_.finish;
    std::vector<Image> images;
    const bool is_loose = is_loosened(loose);
    if (is_loose) {
      images = draw_loosely(draw_alike, loose.draw_roughly);
    } else if (draws_all_first()) {
      images = draw_all(draw_alike);
    }
    find_tone(images, drawn);
    const DisplayGain gain =
        is_shown_ ? display_gain(drawn.finish, scene_.image.gamma) : DisplayGain();
    const DrawFrame draw = with_errors_counted(draw_alike, gain);
    const bool draws_again = !is_loose && gain.total() > 1 && !images.empty() && keeps_promise &&
                             !keeps_promise(gain.total());
    const std::vector<PictureSize> sizes =
        picture_sizes(scene_, frame_.crop.width, frame_.crop.height);
    for (const PictureSize& size : sizes)
      drawn.pictures.push_back(
          {size.suffix,
           Image(),
           Image(),
           {frame_.crop.x, frame_.crop.y, frame_.crop.width, frame_.crop.height}});
    for (std::size_t i = 0; keeps_light_ && i < places_.size(); ++i)
      put(in_crop(images[i]), places_[i], sizes, &Picture::light, drawn.pictures);
    if (draws_again && !moments_.empty()) images = draw_all(draw);
    std::vector<Picture> of_right_eye;
    if (is_anaglyph(scene_)) of_right_eye = drawn.pictures;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const bool is_over = is_anaglyph(scene_) && places_[i].eye == Eye::right;
      std::vector<Picture>& pictures = is_over ? of_right_eye : drawn.pictures;
      if (!is_shown_) continue;
      const bool is_drawn = !images.empty() && (!draws_again || !moments_.empty());
      Image image = is_drawn ? std::move(images[i]) : draw_view(frame_, places_[i], draw);
      add_bloom(image, scene_.finish.bloom);
      image = in_crop(std::move(image));
      finishes_[i].apply(image, drawn.finish, draw);
      put(std::move(image), places_[i], sizes, &Picture::image, pictures);
    }
    for (std::size_t i = 0; i < of_right_eye.size(); ++i) {
      Image& left = drawn.pictures[i].image;
      left = anaglyph(left, of_right_eye[i].image, scene_.stereo->layout, scene_.image.gamma);
    }
    return drawn;
  }

 private:
  // Exposure and bloom come from all of the picture, also where only a part of it is drawn.
  bool needs_whole() const {
    return has_open_tone(scene_.finish) || (is_shown_ && scene_.finish.bloom > 0);
  }

  // Where they are kept as drawn, decide the tone together, or share the moments that are loaded.
  bool draws_all_first() const {
    return keeps_light_ || has_open_tone(scene_.finish) || !moments_.empty();
  }

  // Only for what a display shows: light that is kept as drawn counts as it is.
  bool is_loosened(const LooseDrawing& loose) const {
    return is_shown_ && !keeps_light_ && moments_.empty() && loose.serves && loose.serves(frame_);
  }

  // With errors counted as they are shown, also where that is less often. What exposure makes of
  // them is known beforehand from rough light, and found again from what was drawn.
  std::vector<Image> draw_loosely(const DrawFrame& draw, const DrawFrame& draw_roughly) const {
    constexpr double margin = 1.1;  // for what rough light, and some of its colors, do not tell
    std::vector<Image> images = draw_places(frame_, draw_roughly);
    DisplayGain gain;
    do {  // It ends, since each time the gain is a tenth larger at least.
      gain = gain_of(images);
      gain.of_errors *= margin;
      images = draw_places(frame_, with_errors_counted(draw, gain));
    } while (gain_of(images).total() > gain.total());
    return images;
  }

  DisplayGain gain_of(std::vector<Image> images) const {
    const FinishSettings finish =
        has_open_tone(scene_.finish) ? with_tone_of_all(images) : scene_.finish;
    DisplayGain largest;
    largest.of_light = 0;
    for (Image& image : images) {
      add_bloom(image, scene_.finish.bloom);
      DisplayGain gain = display_gain_of_shown(image, finish, scene_.image.gamma);
      // What bright pixels err by glows over dark ones.
      if (scene_.finish.bloom > 0) gain.of_errors = std::max(1.0, gain.of_errors);
      if (gain.total() > largest.total()) largest = gain;
    }
    return largest;
  }

  FinishSettings with_tone_of_all(const std::vector<Image>& images) const {
    return with_any_tone(scene_.finish, scene_.image.gamma, light_of(images));
  }

  static LightHistogram light_of(const std::vector<Image>& images) {
    LightHistogram light;
    for (const Image& image : images)
      light.add(image);
    return light;
  }

  std::vector<Image> draw_all(const DrawFrame& draw) const {
    if (moments_.empty()) return draw_places(frame_, draw);
    std::vector<Image> mean;
    for (const Moment& moment : moments_) {
      std::vector<std::string> ignored;  // told of the scene itself
      Frame frame = load_frame(moment.scene, *moment.snapshot(), ignored);
      frame.crop = frame_.crop;
      add(draw_places(frame, draw), mean);
    }
    for (Image& image : mean)
      scale(1 / static_cast<float>(moments_.size()), image);
    return mean;
  }

  std::vector<Image> draw_places(const Frame& frame, const DrawFrame& draw) const {
    std::vector<Image> images;
    for (const ViewPlace& place : places_)
      images.push_back(draw_view(frame, place, draw));
    return images;
  }

  void find_tone(const std::vector<Image>& images, DrawnPictures& drawn) const {
    if (!has_open_tone(scene_.finish)) return;
    const LightHistogram light = light_of(images);
    drawn.finish = with_any_tone(scene_.finish, scene_.image.gamma, light);
    drawn.is_black = !with_tone_of(scene_.finish, scene_.image.gamma, light);
  }

  Image draw_view(const Frame& frame, const ViewPlace& place, const DrawFrame& draw) const {
    Frame view = frame_of_view(scene_, frame, place);
    if (needs_whole()) view.crop = {0, 0, view.width, view.height};
    return draw(view);
  }

  Image in_crop(Image image) const {
    const bool is_cut = image.width == frame_.crop.width && image.height == frame_.crop.height;
    return is_cut ? std::move(image) : cut_out(image, frame_.crop);
  }

  // A view that is all of its picture becomes it.
  void put(Image image, const ViewPlace& place, const std::vector<PictureSize>& sizes,
           Image Picture::*part, std::vector<Picture>& pictures) const {
    const auto [columns, rows] = squeezing_of(scene_);
    if (columns * rows > 1) image = squeezed(image, columns, rows);
    std::size_t i = 0;
    while (pictures[i].suffix != place.suffix)
      ++i;
    Image& picture = pictures[i].*part;
    if (image.width == sizes[i].width && image.height == sizes[i].height) {
      picture = std::move(image);
      return;
    }
    if (picture.pixels.empty()) picture = Image(sizes[i].width, sizes[i].height);
    copy_into(image, place.column * image.width, place.row * image.height, picture);
  }

  const Scene& scene_;
  const Frame& frame_;
  const std::vector<Moment>& moments_;  // none without motion blur
  bool is_shown_, keeps_light_;
  std::vector<ViewPlace> places_;
  std::vector<PictureFinish> finishes_;
};

// Of those that the pictures hold.
template <class Change>
void change_both(Picture& picture, const Change& change) {
  for (Image Picture::*part : {&Picture::image, &Picture::light}) {
    if (!(picture.*part).pixels.empty()) change(part);
  }
}

}  // namespace

DrawnPictures draw_pictures(const Scene& scene, const Frame& frame, const SnapshotInfo& snapshot,
                            const DrawFrame& draw, std::vector<std::string>& notes,
                            OtherScenes& other_scenes, PictureLight light,
                            const KeepsPromise& keeps_promise, const std::vector<Moment>& moments,
                            const LooseDrawing& loose) {
  // An anaglyph is what a display shows through glasses, and nothing else.
  if (is_anaglyph(scene)) light = PictureLight::shown;
  const std::optional<Scene> other = cross_fade_scene(scene);
  const auto& [file, amount] = scene.finish.cross_fade;
  DrawnPictures drawn;
  drawn.finish = scene.finish;
  if (other && amount == 1) {
    drawn.pictures =
        other_scenes.draw(file, *other, frame.crop, draw, light, keeps_promise, notes, moments);
  } else {
    drawn = Views(scene, frame, snapshot, light, moments).draw(draw, keeps_promise, loose);
  }
  std::vector<Picture>& pictures = drawn.pictures;
  if (other && amount < 1) {
    const std::vector<Picture> others =
        other_scenes.draw(file, *other, frame.crop, draw, light, keeps_promise, notes, moments);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      const double part_of_other = amount;  // which a lambda may take
      change_both(pictures[i],
                  [&](auto part) { mix(pictures[i].*part, others[i].*part, part_of_other); });
    }
  }
  for (Picture& picture : pictures) {
    change_both(picture,
                [&](auto part) { fade_to_color(picture.*part, scene.finish, scene.image.gamma); });
  }
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
