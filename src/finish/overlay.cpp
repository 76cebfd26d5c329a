#include "finish/overlay.h"

#include <fmt/args.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <filesystem>

#include "finish/tone.h"
#include "image/image_library.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// How much of pixel i lies between the edges.
double overlap(int i, double from, double to) {
  return std::max(0.0, std::min(to, i + 1.0) - std::max<double>(from, i));
}

}  // namespace

float* Canvas::pixel_at(int x, int y) {
  const int column = x - part_.x, row = y - part_.y;
  const bool is_inside = column >= 0 && row >= 0 && column < image_.width && row < image_.height;
  return is_inside ? image_.at(column, row) : nullptr;
}

void Canvas::cover(int x, int y, const Light& light, float coverage) {
  float* const pixel = pixel_at(x, y);
  if (pixel == nullptr) return;
  for (std::size_t c = 0; c < 3; ++c)
    pixel[c] += coverage * (light[c] - pixel[c]);
  pixel[3] += coverage * (1 - pixel[3]);
}

void Canvas::fill(const Box& box, const Light& light, float opacity) {
  const int first_x = std::max(part_.x, static_cast<int>(std::floor(box.left)));
  const int first_y = std::max(part_.y, static_cast<int>(std::floor(box.top)));
  const int end_x = std::min(part_.x + part_.width, static_cast<int>(std::ceil(box.right)));
  const int end_y = std::min(part_.y + part_.height, static_cast<int>(std::ceil(box.bottom)));
  for (int y = first_y; y < end_y; ++y) {
    for (int x = first_x; x < end_x; ++x) {
      const double covered = overlap(x, box.left, box.right) * overlap(y, box.top, box.bottom);
      cover(x, y, light, opacity * static_cast<float>(covered));
    }
  }
}

void Canvas::stamp(const TextMask& mask, int x, int y, const Light& light) {
  std::size_t i = 0;
  for (int row = 0; row < mask.height; ++row) {
    for (int column = 0; column < mask.width; ++column, ++i) {
      if (mask.coverage[i] > 0) cover(x + column, y + row, light, mask.coverage[i]);
    }
  }
}

void Canvas::shade(const TextMask& mask, int x, int y, const Light& light, float opacity) {
  std::size_t i = 0;
  for (int row = 0; row < mask.height; ++row) {
    for (int column = 0; column < mask.width; ++column, ++i) {
      const float coverage = mask.coverage[i];
      float* const pixel = coverage > 0 ? pixel_at(x + column, y + row) : nullptr;
      if (pixel == nullptr) continue;
      for (int c = 0; c < 3; ++c)
        pixel[c] += coverage * (std::min(pixel[c], 1.0F) - pixel[c]);
      cover(x + column, y + row, light, opacity * coverage);
    }
  }
}

void Canvas::paste(const Image& picture, int x, int y) {
  for (int row = 0; row < picture.height; ++row) {
    for (int column = 0; column < picture.width; ++column) {
      const float* from = picture.at(column, row);
      cover(x + column, y + row, {from[0], from[1], from[2]}, 1);
    }
  }
}

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

namespace {

constexpr double margin_part = 0.032;  // of the shorter side

bool overlap(const Box& a, const Box& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

}  // namespace

bool is_at_top(Anchor anchor) {
  return anchor == Anchor::top_left || anchor == Anchor::top || anchor == Anchor::top_right;
}
bool is_at_bottom(Anchor anchor) {
  return anchor == Anchor::bottom_left || anchor == Anchor::bottom ||
         anchor == Anchor::bottom_right;
}
bool is_at_left(Anchor anchor) {
  return anchor == Anchor::top_left || anchor == Anchor::left || anchor == Anchor::bottom_left;
}
bool is_at_right(Anchor anchor) {
  return anchor == Anchor::top_right || anchor == Anchor::right || anchor == Anchor::bottom_right;
}

Layout::Layout(int width, int height)
    : width_(width),
      height_(height),
      unit_(std::min(width, height)),
      margin_(std::round(margin_part * unit_)) {}

Box Layout::place(Anchor anchor, double width, double height, const std::string& what) {
  double& used = used_[static_cast<std::size_t>(anchor)];
  const bool is_stacked = is_at_top(anchor) || is_at_bottom(anchor);
  const double room_x = width_ - 2 * margin_ - (is_stacked ? 0 : used);
  const double room_y = height_ - 2 * margin_ - (is_stacked ? used : 0);
  if (width > room_x || height > room_y) {
    throw UsageError(fmt::format(
        "{}: takes {:.0f} x {:.0f} pixels, expected at most {:.0f} x {:.0f}, which the picture "
        "has left there; make it smaller, or put it to another place (at)",
        what, width, height, room_x, room_y));
  }
  Box box;
  const double depth_x = is_stacked ? 0 : used, depth_y = is_stacked ? used : 0;
  box.left = is_at_left(anchor)    ? margin_ + depth_x
             : is_at_right(anchor) ? width_ - margin_ - depth_x - width
                                   : (width_ - width) / 2;
  box.top = is_at_top(anchor)      ? margin_ + depth_y
            : is_at_bottom(anchor) ? height_ - margin_ - depth_y - height
                                   : (height_ - height) / 2;
  box.left = std::round(box.left);
  box.top = std::round(box.top);
  box.right = box.left + width;
  box.bottom = box.top + height;
  used += (is_stacked ? height : width) + margin_;
  for (const auto& [other, name] : placed_) {
    if (!overlap(box, other)) continue;
    throw UsageError(fmt::format(
        "{}: would lie upon {}; make one of them smaller, or put it to another place (at)", what,
        name));
  }
  placed_.emplace_back(box, what);
  return box;
}

namespace {

using Values = fmt::dynamic_format_arg_store<fmt::format_context>;

std::string file_name(const SnapshotInfo& snapshot) {
  return snapshot.files.empty() ? "" : snapshot.files.front().filename().string();
}

// What stands for a redshift that is not known, to try the format itself.
constexpr double any_redshift = 1;

Values values_of(const SnapshotInfo& snapshot, int frame, bool with_unknown) {
  Values values;
  values.push_back(fmt::arg("time", snapshot.time));
  values.push_back(fmt::arg("frame", frame));
  values.push_back(fmt::arg("snapshot", file_name(snapshot)));
  if (snapshot.redshift || with_unknown) {
    const double redshift = snapshot.redshift.value_or(any_redshift);
    values.push_back(fmt::arg("redshift", redshift));
    values.push_back(fmt::arg("scale_factor", 1 / (1 + redshift)));
  }
  return values;
}

// Whether a placeholder asks for more letters than any number needs: {time:.999999999f}. A width
// that is a placeholder itself could be anything.
bool is_too_wide(const std::string& text) {
  constexpr int most_digits = 2;
  int depth = 0, digits = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool is_twice = i + 1 < text.size() && text[i + 1] == c;
    if (depth == 0 && (c == '{' || c == '}') && is_twice) {
      ++i;  // the brace itself
      continue;
    }
    if (c == '{') ++depth;
    if (c == '}') depth = std::max(0, depth - 1);
    const bool is_digit = depth > 0 && std::isdigit(static_cast<unsigned char>(c)) != 0;
    digits = is_digit ? digits + 1 : 0;
    if (depth > 1 || digits > most_digits) return true;
  }
  return false;
}

}  // namespace

std::string replace_placeholders(const std::string& text, const SnapshotInfo& snapshot, int frame,
                                 const std::string& key) {
  if (is_too_wide(text)) {
    throw UsageError(fmt::format(
        "key {}: found \"{}\", expected placeholders with a width and a precision of at "
        "most 99, as in {{time:8.3f}}",
        key, text));
  }
  try {
    (void)fmt::vformat(text, values_of(snapshot, frame, true));
  } catch (const fmt::format_error& error) {
    throw UsageError(fmt::format(
        "key {}: found \"{}\" ({}), expected placeholders among {{time}}, {{redshift}}, "
        "{{scale_factor}}, {{frame}}, {{snapshot}}, with a format as in {{redshift:.2f}}; "
        "write braces as {{{{ and }}}}",
        key, text, error.what()));
  }
  try {
    return fmt::vformat(text, values_of(snapshot, frame, false));
  } catch (const fmt::format_error&) {
    throw UsageError(
        fmt::format("key {}: found \"{}\", but the snapshot {} has no redshift; use {{time}}", key,
                    text, file_name(snapshot)));
  }
}

}  // namespace splotchcl
