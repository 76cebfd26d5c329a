#pragma once

#include <vector>

#include "device/frame/picture_layout.h"
#include "device/frame/records.h"

namespace splotchcl {

// The rows of tiles of a picture of one grid in which ranks pass it on: while one composites a
// band, the rank before is at the next. A rank waits for as many bands as there are ranks before
// it, and with twice as many bands as ranks for less than half of the time.
std::vector<TileBand> relay_bands(const PictureLayout& layout, int ranks);

// What of the bands lies in this one.
std::vector<TileBand> parts_in(const TileBand& whole, const std::vector<TileBand>& bands);

}  // namespace splotchcl
