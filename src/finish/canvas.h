#pragma once

#include <array>
#include <vector>

#include "image/text.h"
#include "splotchcl/frame.h"
#include "splotchcl/image.h"

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

}  // namespace splotchcl
