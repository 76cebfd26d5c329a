#include <fmt/format.h>

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>

#include "cells/gaussian.h"
#include "cells/shares_in_shells.h"
#include "map/cell_map.h"
#include "map/cell_sums.h"
#include "scene/constants.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using boost::qvm::mag;

double farthest_particle(const CellMatter& matter, const Amounts& amounts) {
  double farthest = 0;
  for (std::size_t i = 0; i < matter.matter.count; ++i) {
    if (amounts.is_good(i)) farthest = std::max(farthest, mag(nearest_offset(matter, i)));
  }
  return farthest;
}

// Up to half of the box, or to the last particle; down to a thousandth of it.
std::array<double, 2> radii_of(const CellMatter& matter, const Amounts& amounts) {
  if (matter.settings.shell) return *matter.settings.shell;
  constexpr double innermost = 1e-3;
  const auto& box = matter.geometry.box;
  const double last =
      box ? 0.5 * std::min({(*box)[0], (*box)[1], (*box)[2]}) : farthest_particle(matter, amounts);
  if (last > 0) return {innermost * last, last};
  throw UsageError(
      "key map.shell: found no particle away from the center, expected the key to be set");
}

std::vector<double> edges_of(const MapAxis& axis) {
  std::vector<double> edges;
  for (int i = 0; i <= axis.cells; ++i)
    edges.push_back(axis.edge(i));
  return edges;
}

double reach_of(const CellMatter& matter, std::size_t i) {
  return kernel_reach * matter.sigma * matter.matter.size_of(i);
}

ImagesAround images_in_reach(const CellMatter& matter, const Amounts& amounts, double last) {
  ImagesAround images;
  for (std::size_t i = 0; i < matter.matter.count; ++i) {
    if (!amounts.is_good(i)) continue;
    const double reach = last + reach_of(matter, i);
    check_images(reach, matter.geometry.box, "key map.shell");
    for (const Vec3& place : images_within(nearest_offset(matter, i), reach, matter.geometry.box)) {
      if (mag(place) < reach) images.add(place, i);
    }
  }
  return images;
}

}  // namespace

CellMap draw_profile(const CellMatter& matter) {
  const Amounts amounts(matter.quantity, matter.matter.count, matter.weight_unit,
                        [&](std::size_t i) { return matter.matter.is_good(i); });
  const auto [first, last] = radii_of(matter, amounts);
  const MapAxis axis = {"radius", "", matter.settings.profile, first, last, true};
  const std::vector<double> edges = edges_of(axis);
  const ImagesAround images = images_in_reach(matter, amounts, last);
  CellSums sums(amounts.kinds(), static_cast<std::size_t>(axis.cells));
  const auto find = [&](std::size_t image, std::vector<CellShare>& shares) {
    const double sigma = matter.sigma * matter.matter.size_of(images.source[image]);
    add_shares_in_shells(edges, mag(images.offset[image]), sigma, shares);
  };
  const auto expected = [&axis](std::size_t) { return static_cast<double>(axis.cells); };
  add_up_shares(amounts, images.source, find, expected, matter.progress, sums);

  CellMap map;
  const auto volume = [&edges](std::size_t cell) {
    const double low = edges[cell], high = edges[cell + 1];
    return 4 * pi / 3 * (high - low) * (high * high + high * low + low * low);
  };
  map.values = values_of(sums, amounts, volume, 0);
  map.width = axis.cells;
  map.height = 1;
  map.axes = {axis};
  map.shell = {{first, last}};
  map.images = images.source.size();
  map.bad = amounts.bad();
  return map;
}

}  // namespace splotchcl
