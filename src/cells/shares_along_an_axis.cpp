#include "cells/shares_along_an_axis.h"

#include <algorithm>
#include <cmath>

#include "cells/gaussian.h"

namespace splotchcl {
namespace {

// `from` is the particle's place from the first edge.
void add_row(const CellsAlongAxis& cells, double from, double sigma,
             std::vector<SharesAlongAxis>& rows) {
  const double reach = kernel_reach * sigma, last = cells.count;
  const double low = std::clamp(std::floor((from - reach) / cells.width), 0.0, last);
  const double high = std::clamp(std::floor((from + reach) / cells.width) + 1, 0.0, last);
  if (!(high > low)) return;
  SharesAlongAxis row;
  row.first = static_cast<int>(low);
  for (double cell = low; cell < high; ++cell)
    row.parts.push_back(
        gaussian_between(cell * cells.width - from, (cell + 1) * cells.width - from, sigma));
  rows.push_back(std::move(row));
}

}  // namespace

void find_shares_along_axis(const CellsAlongAxis& cells, double place, double sigma,
                            std::vector<SharesAlongAxis>& rows) {
  rows.clear();
  const double from = place - cells.first;
  if (!cells.period) {
    add_row(cells, from, sigma, rows);
    return;
  }
  const double period = *cells.period, reach = kernel_reach * sigma;
  const double first = std::ceil((-reach - from) / period);
  const double last = std::floor((cells.count * cells.width + reach - from) / period);
  for (double image = first; image <= last; ++image)
    add_row(cells, from + image * period, sigma, rows);
}

}  // namespace splotchcl
