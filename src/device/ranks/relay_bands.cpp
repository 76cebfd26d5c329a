#include "device/ranks/relay_bands.h"

#include <algorithm>

namespace splotchcl {

std::vector<TileBand> relay_bands(const PictureLayout& layout, int ranks) {
  const shared::Grid& grid = layout.grids.front();
  const auto across = static_cast<std::uint32_t>(grid.tiles_x);
  const auto rows = static_cast<std::uint32_t>(grid.tiles_y);
  const std::uint32_t bands = std::min(rows, 2 * static_cast<std::uint32_t>(ranks));
  std::vector<TileBand> cut;
  for (std::uint32_t band = 0; band < bands; ++band) {
    const auto row_of = [&](std::uint32_t border) {
      return static_cast<std::uint32_t>(std::uint64_t{rows} * border / bands);
    };
    cut.push_back({row_of(band) * across, row_of(band + 1) * across});
  }
  return cut;
}

std::vector<TileBand> parts_in(const TileBand& whole, const std::vector<TileBand>& bands) {
  std::vector<TileBand> parts;
  for (const TileBand& band : bands) {
    const TileBand part = {std::max(whole.first, band.first), std::min(whole.end, band.end)};
    if (part.first < part.end) parts.push_back(part);
  }
  return parts;
}

}  // namespace splotchcl
