#include "finish/text_style.h"

#include <algorithm>
#include <cmath>

#include "finish/adjust_light.h"
#include "image/image_library.h"

namespace splotchcl {
namespace {

constexpr float shade_opacity = 0.65F;

// The letters, grown and blurred by a part of their size.
TextMask shade_of(const TextMask& letters, double size) {
  TextMask shade = letters;
  const auto reach = static_cast<float>(std::max(3.0, 0.3 * size));
  const std::vector<float> values =
      image_library().blurred(letters.coverage, letters.width, letters.height, reach);
  // Thin letters cover little of the filter's reach.
  for (std::size_t i = 0; i < values.size(); ++i)
    shade.coverage[i] = std::clamp(2.5F * values[i], 0.0F, 1.0F);
  return shade;
}

// The shade behind letters: dark behind light ones, light behind dark ones.
DisplayColor opposite(const DisplayColor& color) {
  const double luminance = 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2];
  return luminance > 0.4 ? DisplayColor{0, 0, 0} : DisplayColor{1, 1, 1};
}

}  // namespace

TextStyle::TextStyle(const FinishSettings& finish, double gamma, double unit)
    : font_(finish.font),
      size_(finish.text_size * unit),
      line_(std::max(1.0, std::round(0.07 * size_))),
      color_(light_of(finish.text_color, gamma)),
      shade_(light_of(opposite(finish.text_color), gamma)),
      has_superscripts_(font_.has(U'\u2070') && font_.has(U'\u00b9') && font_.has(U'\u2074') &&
                        font_.has(U'\u207b') && font_.has(U'\u00d7')) {}

ShadedText TextStyle::draw(const std::string& text, double size, TextAlignment alignment) const {
  TextMask letters = font_.draw(text, size, alignment);
  TextMask shade = shade_of(letters, size);
  return {std::move(letters), std::move(shade)};
}

void TextStyle::put(Canvas& canvas, const ShadedText& text, double x, double y) const {
  const int left = static_cast<int>(std::lround(x)) + text.letters.left;
  const int top = static_cast<int>(std::lround(y)) + text.letters.top;
  canvas.shade(text.shade, left, top, shade_, shade_opacity);
  canvas.stamp(text.letters, left, top, color_);
}

void TextStyle::put(Canvas& canvas, const Box& box) const {
  const double edge = line_;
  canvas.fill({box.left - edge, box.top - edge, box.right + edge, box.bottom + edge}, shade_,
              shade_opacity / 2);
  canvas.fill(box, color_);
}

TextMask turned(const TextMask& mask) {
  TextMask result;
  result.width = mask.height;
  result.height = mask.width;
  result.coverage.resize(mask.coverage.size());
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      const int to_x = y, to_y = mask.width - 1 - x;
      result.coverage[static_cast<std::size_t>(to_y) * static_cast<std::size_t>(result.width) +
                      static_cast<std::size_t>(to_x)] =
          mask.coverage[static_cast<std::size_t>(y) * static_cast<std::size_t>(mask.width) +
                        static_cast<std::size_t>(x)];
    }
  }
  result.box_width = mask.box_height;
  result.box_height = mask.box_width;
  result.left = mask.top;
  result.top = -(mask.width + mask.left - mask.box_width);
  return result;
}

ShadedText turned(const ShadedText& text) {
  return {turned(text.letters), turned(text.shade)};
}

}  // namespace splotchcl
