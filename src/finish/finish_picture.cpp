#include "finish/finish_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <memory>

#include "common/words.h"
#include "finish/bars.h"
#include "finish/effects.h"
#include "finish/overlay.h"
#include "finish/tone.h"
#include "image/image_library.h"
#include "image/text.h"
#include "scene/constants.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr double degrees = 180 / pi;

// The inset's camera: the picture's own, as its frame has it, where nothing else is said.
Camera camera_of(const InsetSettings& settings, const Frame& frame) {
  const CameraFrame& own = frame.camera;
  Camera camera;
  camera.projection = frame.projection;
  camera.near_limit = frame.near_limit;
  camera.far_limit = frame.far_limit;
  camera.position = settings.position.value_or(own.position);
  camera.look_at =
      settings.look_at.value_or(Vec3(own.position + own.forward * own.look_at_distance));
  camera.sky = settings.sky.value_or(boost::qvm::cross(own.right, own.forward));
  camera.field_of_view_degrees = settings.field_of_view_degrees;
  if (is_wide_angle(frame.projection)) {
    camera.projection = Projection::perspective;
  } else if (!camera.field_of_view_degrees) {
    camera.field_of_view_degrees = 2 * degrees * std::atan(0.5 * frame.width / own.focal_pixels);
  }
  return camera;
}

void keep_components(const std::vector<std::string>& names, std::vector<DrawnComponent>& all) {
  if (names.empty()) return;
  const auto is_hidden = [&names](const DrawnComponent& component) {
    return std::find(names.begin(), names.end(), component.name) == names.end();
  };
  all.erase(std::remove_if(all.begin(), all.end(), is_hidden), all.end());
}

// With two eyes, those of the inset are as far apart as suits its own look-at point.
CameraFrame inset_camera(const Scene& scene, const Frame& frame, std::optional<Eye> eye, int width,
                         int height) {
  try {
    const Camera camera = camera_of(scene.finish.inset, frame);
    CameraFrame seen = make_camera_frame(camera, width, height);
    if (scene.image.convention == PixelConvention::original) seen = in_original_convention(seen);
    return eye ? eye_camera(seen, camera.projection, *scene.stereo, *eye) : seen;
  } catch (const UsageError& error) {
    throw UsageError(std::string("finish.inset: ") + error.what());
  }
}

}  // namespace

void check_inset(const Scene& scene) {
  std::vector<std::string> known;
  for (const Component& component : scene.components)
    known.push_back(component.name);
  for (const std::string& name : scene.finish.inset.components) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw UsageError(fmt::format(
        "key finish.inset.components: found \"{}\", expected names of components, which are "
        "\"{}\"{}",
        name, fmt::join(known, "\", \""), did_you_mean(nearest_name(name, known))));
  }
}

Inset make_inset(const Scene& scene, const Frame& frame, std::optional<Eye> eye, Layout& layout) {
  const InsetSettings& settings = scene.finish.inset;
  const int width = std::max(1, static_cast<int>(std::lround(settings.size[0] * frame.width)));
  const int height = std::max(1, static_cast<int>(std::lround(settings.size[1] * frame.height)));
  const double border = std::ceil(settings.border * layout.unit());
  const Box box =
      layout.place(settings.at, width + 2 * border, height + 2 * border, "finish.inset");

  Inset inset;
  inset.border = box;
  inset.border_light = light_of(settings.border_color, scene.image.gamma);
  inset.x = static_cast<int>(box.left + border);
  inset.y = static_cast<int>(box.top + border);
  inset.frame = frame;
  inset.frame.width = width;
  inset.frame.height = height;
  inset.frame.crop = {0, 0, width, height};
  inset.frame.camera = inset_camera(scene, frame, eye, width, height);
  if (is_wide_angle(frame.projection)) inset.frame.projection = Projection::perspective;
  if (frame.background_image) {
    inset.frame.background_image =
        std::make_shared<const Image>(scaled_to_fill(*frame.background_image, width, height));
  }
  keep_components(settings.components, inset.frame.components);
  return inset;
}

void put(Canvas& canvas, const Inset& inset, const Image& picture) {
  canvas.fill(inset.border, inset.border_light);
  canvas.paste(picture, inset.x, inset.y);
}

namespace {

struct NamedText {
  const char* key;
  const TextSettings& text;
  double default_size;  // in text sizes
};

std::vector<NamedText> texts_of(const FinishSettings& finish) {
  return {{"finish.title", finish.title, 1.5},
          {"finish.label", finish.label, 1},
          {"finish.caption", finish.caption, 1}};
}

bool has_text(const FinishSettings& finish) {
  bool has_any = finish.color_bar.show || finish.scale_bar.show;
  for (const NamedText& named : texts_of(finish))
    has_any = has_any || !named.text.text.empty();
  return has_any;
}

TextAlignment alignment_at(Anchor anchor) {
  if (is_at_right(anchor)) return TextAlignment::right;
  return is_at_left(anchor) ? TextAlignment::left : TextAlignment::center;
}

std::string words_of(const NamedText& named, const FinishSettings& finish,
                     const SnapshotInfo& snapshot) {
  return replace_placeholders(named.text.text, snapshot, finish.frame.value_or(0),
                              std::string(named.key) + ".text");
}

Overlay make_text(const NamedText& named, const FinishSettings& finish,
                  const SnapshotInfo& snapshot, const TextStyle& style, Layout& layout) {
  const double size =
      named.text.size ? *named.text.size * layout.unit() : named.default_size * style.size();
  const ShadedText text =
      style.draw(words_of(named, finish, snapshot), size, alignment_at(named.text.at));
  const Box box =
      layout.place(named.text.at, text.letters.box_width, text.letters.box_height, named.key);
  return [=](Canvas& canvas) { style.put(canvas, text, box.left, box.top); };
}

}  // namespace

std::optional<std::filesystem::path> font_file(const FinishSettings& finish) {
  if (!has_text(finish)) return std::nullopt;
  try {
    return find_font(finish.font);
  } catch (const UsageError&) {
    return std::nullopt;  // said where it is drawn with
  }
}

void check_finish(const Scene& scene, const SnapshotInfo& snapshot) {
  const FinishSettings& finish = scene.finish;
  if (has_text(finish)) {
    const TextStyle style(finish, scene.image.gamma, 1000);
    for (const NamedText& named : texts_of(finish)) {
      if (!named.text.text.empty()) style.draw(words_of(named, finish, snapshot), 10);
    }
  }
  if (finish.color_bar.show) (void)components_with_bars(scene);
  if (finish.inset.show) check_inset(scene);
  check_cross_fade(scene);
}

PictureFinish::PictureFinish(const Scene& scene, const Frame& frame, const SnapshotInfo& snapshot,
                             std::optional<Eye> eye)
    : settings_(scene.finish), gamma_(scene.image.gamma), crop_(frame.crop) {
  Layout layout(frame.width, frame.height);
  if (settings_.inset.show) inset_ = make_inset(scene, frame, eye, layout);
  prepare(scene, frame, snapshot, std::nullopt, layout);
}

PictureFinish::PictureFinish(const Scene& scene, const Frame& frame, const SnapshotInfo& snapshot,
                             const ColorBarContent& color_bar)
    : settings_(scene.finish), gamma_(scene.image.gamma), crop_(frame.crop) {
  Layout layout(frame.width, frame.height);
  prepare(scene, frame, snapshot, color_bar, layout);
}

void PictureFinish::prepare(const Scene& scene, const Frame& frame, const SnapshotInfo& snapshot,
                            const std::optional<ColorBarContent>& color_bar, Layout& layout) {
  if (!has_text(settings_)) return;
  const TextStyle style(settings_, gamma_, layout.unit());
  for (const NamedText& named : texts_of(settings_)) {
    if (named.text.text.empty()) continue;
    overlays_.push_back(make_text(named, settings_, snapshot, style, layout));
  }
  if (settings_.scale_bar.show) {
    overlays_.push_back(make_scale_bar(settings_.scale_bar, frame, snapshot, style, layout));
  }
  if (settings_.color_bar.show) {
    const std::vector<ColorBarContent> bars =
        color_bar ? std::vector<ColorBarContent>{*color_bar}
                  : color_bars_of(scene, frame, snapshot, style.has_superscripts());
    for (const Overlay& bar : make_color_bars(bars, settings_.color_bar, frame, style, layout))
      overlays_.push_back(bar);
  }
}

void PictureFinish::apply(Image& image, const FinishSettings& light, const DrawFrame& draw) const {
  adjust_light(image, light, gamma_);
  Canvas canvas(image, crop_);
  if (inset_) {
    Image picture = draw(inset_->frame);
    add_bloom(picture, light.bloom);
    adjust_light(picture, light, gamma_);
    put(canvas, *inset_, picture);
  }
  for (const Overlay& overlay : overlays_)
    overlay(canvas);
}

}  // namespace splotchcl
