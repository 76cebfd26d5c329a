#pragma once

#include <cstddef>
#include <vector>

#include "device/frame/shared.h"
#include "device/frame/variant.h"

namespace splotchcl {

// Where a tile's cells are, in which the stage `certify` collects: sets peaks, endings, listed and
// cells_per_tile. Throws DeviceError where tiles are neither squares nor twice as wide as high: the
// numbers of their pixels would not follow each other (certify.h).
void lay_out_cells(const Variant& variant, shared::CertifyParameters& parameters);

// The numbers of the cells in a row of a tile, among those of their octave in the tile.
std::vector<std::size_t> numbers_of_cells(int columns, int row);

}  // namespace splotchcl
