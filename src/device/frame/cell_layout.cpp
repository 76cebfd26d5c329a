#include "device/frame/cell_layout.h"

#include <cstdint>
#include <utility>

#include "certificate/peak_cells.h"

namespace splotchcl {
namespace {

// Where the cells of a tile of `width` by `height` pixels begin, octave by octave.
void lay_out(int (*shift_of)(int octave), std::uint32_t width, std::uint32_t height,
             shared::OctaveCells* octaves, std::uint32_t& count) {
  for (int octave = 0; octave < WIDTH_OCTAVES; ++octave) {
    const int shift = shift_of(octave);
    octaves[octave] = {count, shift};
    count += (width >> shift) * (height >> shift);
  }
}

}  // namespace

void lay_out_cells(const Specialization& specialization, shared::CertifyParameters& parameters) {
  parameters.cells_per_tile = 0;
  for (const auto& [shift_of, octaves] : {std::pair(&peak_cell_shift, parameters.peaks),
                                          std::pair(&ending_cell_shift, parameters.endings)}) {
    lay_out(shift_of, specialization.tile_width(), specialization.tile_height(), octaves,
            parameters.cells_per_tile);
  }
  parameters.listed = parameters.cells_per_tile++;
}

}  // namespace splotchcl
