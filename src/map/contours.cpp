#include "map/contours.h"

#include <cmath>

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

}  // namespace splotchcl
