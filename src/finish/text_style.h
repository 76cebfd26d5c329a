#pragma once

#include <functional>
#include <memory>
#include <string>

#include "finish/canvas.h"
#include "image/text.h"
#include "splotchcl/finish.h"

namespace splotchcl {

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

}  // namespace splotchcl
