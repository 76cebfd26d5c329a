#pragma once

#include "device/frame/shared.h"
#include "device/frame/specialization.h"

namespace splotchcl {

// Where a tile's cells are, in which the stage `certify` collects: sets peaks, endings, listed and
// cells_per_tile.
void lay_out_cells(const Specialization& specialization, shared::CertifyParameters& parameters);

}  // namespace splotchcl
