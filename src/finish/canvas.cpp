#include "finish/canvas.h"

#include <algorithm>
#include <cmath>

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

}  // namespace splotchcl
