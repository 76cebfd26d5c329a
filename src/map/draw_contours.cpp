#include <algorithm>
#include <cmath>
#include <vector>

#include "map/figure.h"

namespace splotchcl {
namespace {

double distance_to(const ContourPiece& piece, double x, double y) {
  const auto& [a, b] = piece;
  const double dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
  const double along =
      square > 0 ? std::clamp(((x - a[0]) * dx + (y - a[1]) * dy) / square, 0.0, 1.0) : 0;
  return std::hypot(x - a[0] - along * dx, y - a[1] - along * dy);
}

// How much of each pixel the lines cover. Where pieces meet the larger counts, not both.
std::vector<float> coverage_of(const std::vector<ContourPiece>& pieces, double width,
                               const Image& image) {
  std::vector<float> coverage(image.pixels.size() / 4, 0.0F);
  const double reach = 0.5 * width + 0.5;
  for (const ContourPiece& piece : pieces) {
    const auto& [a, b] = piece;
    const int left = static_cast<int>(std::floor(std::min(a[0], b[0]) - reach - 0.5)),
              right = static_cast<int>(std::ceil(std::max(a[0], b[0]) + reach)),
              top = static_cast<int>(std::floor(std::min(a[1], b[1]) - reach - 0.5)),
              bottom = static_cast<int>(std::ceil(std::max(a[1], b[1]) + reach));
    for (int y = std::max(0, top); y < std::min(image.height, bottom); ++y) {
      for (int x = std::max(0, left); x < std::min(image.width, right); ++x) {
        const double part = std::clamp(reach - distance_to(piece, x + 0.5, y + 0.5), 0.0, 1.0);
        float& covered =
            coverage[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                     static_cast<std::size_t>(x)];
        covered = std::max(covered, static_cast<float>(part));
      }
    }
  }
  return coverage;
}

void cover(const std::vector<float>& coverage, float light, float opacity, Image& image) {
  for (std::size_t i = 0; i < coverage.size(); ++i) {
    const float part = opacity * coverage[i];
    for (std::size_t c = 0; c < 3; ++c) {
      float& value = image.pixels[4 * i + c];
      value += part * (light - value);
    }
  }
}

}  // namespace

// White with a dark edge, which shows on any palette.
void draw_contours(const std::vector<ContourPiece>& pieces, double width, Image& image) {
  cover(coverage_of(pieces, 2.5 * width, image), 0, 0.6F, image);
  cover(coverage_of(pieces, width, image), 1, 1, image);
}

}  // namespace splotchcl
