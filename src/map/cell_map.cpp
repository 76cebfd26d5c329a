#include "map/cell_map.h"

#include <fmt/format.h>

#include "parallel/available_memory.h"
#include "splotchcl/error.h"
#include "splotchcl/periodic.h"

namespace splotchcl {

Vec3 nearest_offset(const CellMatter& matter, std::size_t i) {
  const MapGeometry& geometry = matter.geometry;
  Vec3 offset = matter.matter.position_of(i) - geometry.center;
  for (std::size_t axis = 0; axis < 3 && geometry.box; ++axis)
    offset.a[axis] = nearest_image(offset.a[axis], (*geometry.box)[axis]);
  return offset;
}

void check_cells(double cells, std::size_t kinds, const std::string& what) {
  // Sums, values, and these in single precision as they are and as they are written.
  const double bytes = cells * (8.0 * static_cast<double>(kinds) + 8 + 3 * 4);
  const auto available = static_cast<double>(available_memory());
  constexpr double gigabyte = 1e9, most_cells = 4e9;
  if (bytes <= available && cells <= most_cells) return;
  throw UsageError(fmt::format(
      "{}: {:.4g} cells take {:.3g} GB of memory, expected at most {:.3g} GB, which are available",
      what, cells, bytes / gigabyte, available / gigabyte));
}

}  // namespace splotchcl
