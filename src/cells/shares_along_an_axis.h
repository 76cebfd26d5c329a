#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace splotchcl {

// Cells of equal width side by side.
struct CellsAlongAxis {
  double first = 0, width = 1;  // of the first one its lower edge
  int count = 0;
  std::optional<double> period;  // of a periodic box, whose images count, too
};

// Cells in a row, and how much of a particle lies in each.
struct SharesAlongAxis {
  int first = 0;
  std::vector<double> parts;

  int end() const { return first + static_cast<int>(parts.size()); }
};

// One row for each image that reaches the cells.
void find_shares_along_axis(const CellsAlongAxis& cells, double place, double sigma,
                            std::vector<SharesAlongAxis>& rows);

}  // namespace splotchcl
