#include "device/frame/cell_layout.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace splotchcl {
namespace {

// No wider than the smallest tile.
constexpr int widest_shift = 4;
// No narrower than two pixels, and four for peaks: together they take 3.5 bytes per pixel.
constexpr int narrowest_ending_shift = 1, narrowest_peak_shift = 2;

// Cells of an octave are as wide as its widest splats.
int cell_shift(int octave, int narrowest) {
  return std::clamp(octave, narrowest, widest_shift);
}

// Where the cells of a tile of `width` by `height` pixels begin, octave by octave.
void lay_out(int narrowest, std::uint32_t width, std::uint32_t height, shared::OctaveCells* octaves,
             std::uint32_t& count) {
  for (int octave = 0; octave < WIDTH_OCTAVES; ++octave) {
    const int shift = cell_shift(octave, narrowest);
    octaves[octave] = {count, shift};
    count += (width >> shift) * (height >> shift);
  }
}

}  // namespace

void lay_out_cells(const Specialization& specialization, shared::CertifyParameters& parameters) {
  parameters.cells_per_tile = 0;
  for (const auto& [narrowest, octaves] : {std::pair(narrowest_peak_shift, parameters.peaks),
                                           std::pair(narrowest_ending_shift, parameters.endings)}) {
    lay_out(narrowest, specialization.tile_width(), specialization.tile_height(), octaves,
            parameters.cells_per_tile);
  }
  parameters.listed = parameters.cells_per_tile++;
}

}  // namespace splotchcl
