#include <cmath>
#include <limits>

#include "cells/healpix_grid.h"
#include "map/figure.h"
#include "scene/constants.h"

namespace splotchcl {
namespace {

// The direction that is seen at a place of the ellipse, from -1 to 1 along both of its axes.
Vec3 direction_at(double x, double y) {
  const double angle = std::asin(y), half_width = std::cos(angle);
  const double latitude = std::asin((2 * angle + std::sin(2 * angle)) / pi);
  const double longitude = half_width > 0 ? -pi * x / half_width : 0;
  return {{std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
           std::sin(latitude)}};
}

}  // namespace

Map picture_of_sphere(const Map& map, int width) {
  Map picture = map;
  picture.width = width;
  picture.height = (width + 1) / 2;
  picture.values.clear();
  const HealpixGrid grid(map.healpix->nside, map.healpix->order);
  for (int row = 0; row < picture.height; ++row) {
    for (int column = 0; column < picture.width; ++column) {
      const double x = 2 * (column + 0.5) / picture.width - 1,
                   y = 1 - 2 * (row + 0.5) / picture.height;
      const bool is_sky = x * x + y * y < 1;
      picture.values.push_back(is_sky ? map.values[*grid.cell_at(direction_at(x, y))]
                                      : std::numeric_limits<float>::quiet_NaN());
    }
  }
  return picture;
}

}  // namespace splotchcl
