#include "finish/finish_picture.h"

#include <memory>

#include "finish/bars.h"
#include "finish/bloom.h"
#include "finish/joined_pictures.h"
#include "finish/placeholders.h"
#include "finish/tone.h"
#include "image/text.h"
#include "splotchcl/error.h"

namespace splotchcl {
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
