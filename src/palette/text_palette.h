#pragma once

#include <string>
#include <vector>

#include "palette/palette_lines.h"
#include "splotchcl/palette.h"

namespace splotchcl {

// Lines of numbers: red, green and blue of a knot, from 0 to 1 or as whole numbers to 255. With
// absorption in three more columns; with a place before or an opacity of 1 behind them; as
// #rrggbb; or as GIMP has them, with names behind. Throws DataError.
Palette read_text_palette(const std::vector<PaletteLine>& lines, const std::string& name);

// Red, green and blue from 0 to 255.
Rgb read_bytes_of_color(const PaletteLine& line, const std::string& name);

}  // namespace splotchcl
