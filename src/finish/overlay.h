#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "image/text.h"
#include "splotchcl/finish.h"
#include "splotchcl/frame.h"
#include "splotchcl/image.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

using Light = std::array<float, 3>;

// Edges in pixels of the whole picture; parts of pixels are covered in part.
struct Box {
  double left = 0, top = 0, right = 0, bottom = 0;
};

// A picture, or the part of it that is drawn, to put things upon. Coordinates are those of
// the whole picture; what lies outside of the part is left out. Light is mixed linearly:
// coverage a leaves 1 - a of what is there.
class Canvas {
 public:
  // `part` is the image's place in the whole picture.
  Canvas(Image& image, const Rectangle& part) : image_(image), part_(part) {}

  void cover(int x, int y, const Light& light, float coverage);
  void fill(const Box& box, const Light& light, float opacity = 1);
  // The mask's own corner at (x, y).
  void stamp(const TextMask& mask, int x, int y, const Light& light);
  // Darkens (or brightens) to make room for letters: light above the display's white is
  // first brought down to it, or much of it would shine through.
  void shade(const TextMask& mask, int x, int y, const Light& light, float opacity);
  // Opaque.
  void paste(const Image& picture, int x, int y);

 private:
  float* pixel_at(int x, int y);  // null outside of the part

  Image& image_;
  Rectangle part_;
};

// Something that has been prepared, and only needs a picture to be put upon.
using Overlay = std::function<void(Canvas&)>;

// Letters with a soft shade around them, which keeps them readable on any picture.
struct ShadedText {
  TextMask letters, shade;
};

// How all text of a picture looks.
class TextStyle {
 public:
  // `unit` is the picture's shorter side in pixels.
  TextStyle(const FinishSettings& finish, double gamma, double unit);

  double size() const { return size_; }  // of letters, in pixels
  double line() const { return line_; }  // width of lines and ticks' strokes, in pixels
  const Light& color() const { return color_; }
  const Light& shade() const { return shade_; }
  bool has_superscripts() const { return has_superscripts_; }

  // Throws UsageError for letters that the font does not have.
  ShadedText draw(const std::string& text, double size,
                  TextAlignment alignment = TextAlignment::left) const;
  // The text's box at (x, y).
  void put(Canvas& canvas, const ShadedText& text, double x, double y) const;
  // A bar with a shade around it.
  void put(Canvas& canvas, const Box& box) const;

 private:
  Font font_;
  double size_, line_;
  Light color_, shade_;
  bool has_superscripts_;
};

// The same text, read from below to above.
TextMask turned(const TextMask& mask);
ShadedText turned(const ShadedText& text);

// Finds room for what is put upon a picture. Things at the same anchor stand below each
// other: at the top from the edge downwards, at the bottom upwards, and at the left and
// right, in the middle of their height, beside each other.
class Layout {
 public:
  Layout(int width, int height);

  // The shorter side in pixels, which sizes of letters and lines are parts of.
  double unit() const { return unit_; }

  // Room of this size. Throws UsageError, naming `what`, where the picture has too little or
  // something else lies there.
  Box place(Anchor anchor, double width, double height, const std::string& what);

 private:
  double width_, height_, unit_, margin_;
  std::array<double, 8> used_{};  // depth from the margin inwards, by anchor
  std::vector<std::pair<Box, std::string>> placed_;
};

bool is_at_top(Anchor anchor);
bool is_at_bottom(Anchor anchor);
bool is_at_left(Anchor anchor);
bool is_at_right(Anchor anchor);

// The text with its placeholders replaced, in the way of Python's and fmt's format strings:
//   {time}          time of the snapshot, as its header has it
//   {redshift}      redshift
//   {scale_factor}  1 / (1 + redshift)
//   {frame}         number of a film's frame, 0 for a single picture
//   {snapshot}      name of the snapshot's file
// A format may follow the name: {redshift:.2f}, {frame:04}. {{ and }} are braces.
// `key` names the scene's key in messages. Throws UsageError for placeholders that are
// unknown or have no value.
std::string replace_placeholders(const std::string& text, const SnapshotInfo& snapshot, int frame,
                                 const std::string& key);

}  // namespace splotchcl
