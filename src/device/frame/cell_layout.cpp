#include "device/frame/cell_layout.h"

#include <cstdint>
#include <string>
#include <utility>

#include "certificate/peak_cells.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// Where the cells of a tile of `width` by `height` pixels begin, octave by octave.
void lay_out(int (*shift_of)(int octave), std::uint32_t width, std::uint32_t height,
             shared::OctaveCells* octaves, std::uint32_t& count) {
  for (int octave = 0; octave < WIDTH_OCTAVES; ++octave) {
    const int shift = shift_of(octave);
    octaves[octave] = {count, 2 * shift};
    count += (width >> shift) * (height >> shift);
  }
}

}  // namespace

void lay_out_cells(const Variant& variant, shared::CertifyParameters& parameters) {
  const std::uint32_t width = variant.tile_width, height = variant.tile_height;
  if (width != height && width != 2 * height) {
    throw DeviceError("tiles of " + std::to_string(width) + "x" + std::to_string(height) +
                      " pixels: they have to be squares, or twice as wide as high");
  }
  parameters.cells_per_tile = 0;
  for (const auto& [shift_of, octaves] : {std::pair(&peak_cell_shift, parameters.peaks),
                                          std::pair(&ending_cell_shift, parameters.endings)}) {
    lay_out(shift_of, width, height, octaves, parameters.cells_per_tile);
  }
  parameters.listed = parameters.cells_per_tile++;
}

std::vector<std::size_t> numbers_of_cells(int columns, int row) {
  std::vector<std::size_t> numbers(static_cast<std::size_t>(columns));
  for (std::size_t column = 0; column < numbers.size(); ++column) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      numbers[column] |= (column >> bit & 1) << 2 * bit;
      numbers[column] |= (static_cast<std::size_t>(row) >> bit & 1) << (2 * bit + 1);
    }
  }
  return numbers;
}

}  // namespace splotchcl
