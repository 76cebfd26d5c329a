#include <algorithm>
#include <cmath>
#include <vector>

#include "map/figure.h"

namespace splotchcl {
namespace {

using Place = std::array<double, 2>;

// Four neighboring pixels around a square: top left, top right, bottom right, bottom left.
class Square {
 public:
  Square(const Map& map, int column, int row, double level)
      : column_(column), row_(row), level_(level) {
    constexpr int right[] = {0, 1, 1, 0}, down[] = {0, 0, 1, 1};
    for (std::size_t k = 0; k < 4; ++k) {
      const int x = column + right[k], y = row + down[k];
      values_[k] = static_cast<double>(map.values[static_cast<std::size_t>(y * map.width + x)]);
    }
  }

  void add_pieces(std::vector<ContourPiece>& pieces) const {
    std::vector<Place> crossings;
    for (std::size_t side = 0; side < 4; ++side) {
      if (is_above(side) != is_above((side + 1) % 4)) crossings.push_back(crossing(side));
    }
    if (crossings.size() == 2) pieces.push_back({crossings[0], crossings[1]});
    if (crossings.size() < 4) return;
    // Sides in order are top, right, bottom, left: the pieces cut off two opposite corners.
    const double mean = (values_[0] + values_[1] + values_[2] + values_[3]) / 4;
    const bool cuts_top_right = (mean >= level_) == is_above(0);
    const std::size_t first = cuts_top_right ? 1 : 3;
    pieces.push_back({crossings[0], crossings[first]});
    pieces.push_back({crossings[2], crossings[4 - first]});
  }

  bool is_known() const { return std::isfinite(values_[0] + values_[1] + values_[2] + values_[3]); }

 private:
  bool is_above(std::size_t corner) const { return values_[corner] >= level_; }

  Place corner(std::size_t k) const {
    return {column_ + 0.5 + (k == 1 || k == 2 ? 1 : 0), row_ + 0.5 + (k >= 2 ? 1 : 0)};
  }

  Place crossing(std::size_t side) const {
    const std::size_t next = (side + 1) % 4;
    const double part = (level_ - values_[side]) / (values_[next] - values_[side]);
    const Place a = corner(side), b = corner(next);
    return {a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])};
  }

  int column_, row_;
  double level_;
  std::array<double, 4> values_;
};

}  // namespace

std::vector<ContourPiece> contour_pieces(const Map& map, double level) {
  std::vector<ContourPiece> pieces;
  for (int row = 0; row + 1 < map.height; ++row) {
    for (int column = 0; column + 1 < map.width; ++column) {
      const Square square(map, column, row, level);
      if (square.is_known()) square.add_pieces(pieces);
    }
  }
  return pieces;
}

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
