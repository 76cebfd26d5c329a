#include "device/drawn_picture.h"

#include <algorithm>
#include <cstddef>

namespace splotchcl {

void paste(const DrawnPicture& part, const Rectangle& at, DrawnPicture& whole) {
  constexpr int side = BlockErrors::block_pixels;
  for (int y = 0; y < at.height; ++y) {
    std::copy_n(part.image.at(0, y), 4 * static_cast<std::ptrdiff_t>(at.width),
                whole.image.at(at.x, at.y + y));
  }
  whole.certificate.is_bound &= part.certificate.is_bound;
  BlockErrors& blocks = whole.certificate.blocks;
  const BlockErrors& drawn = part.certificate.blocks;
  for (int y = 0; y < drawn.rows; ++y) {
    for (int x = 0; x < drawn.columns; ++x) {
      blocks
          .errors[static_cast<std::size_t>((at.y / side + y) * blocks.columns + at.x / side + x)] =
          drawn.at(x * side, y * side);
    }
  }
}

ErrorParts worst_within(const std::vector<ErrorParts>& candidates, double error_of_promise) {
  constexpr double rounding = 1e-6;
  ErrorParts worst;
  for (const ErrorParts& parts : candidates) {
    if (parts.sum() <= error_of_promise * (1 + rounding) && parts.sum() > worst.sum())
      worst = parts;
  }
  return worst;
}

}  // namespace splotchcl
