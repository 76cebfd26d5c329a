#include "galaxy/center.h"

#include <algorithm>
#include <cmath>

#include "galaxy/light.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using PixelPlace = std::array<double, 2>;

// The centroid of what lies within a radius; the point itself where that is dark.
PixelPlace centroid(const Image& picture, const PixelPlace& point, double radius) {
  double sum = 0;
  PixelPlace weighted = {0, 0};
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const double px = x + 0.5, py = y + 0.5;
      if (std::hypot(px - point[0], py - point[1]) > radius) continue;
      const double light = mean(light_at(picture, x, y));
      sum += light;
      weighted[0] += light * px;
      weighted[1] += light * py;
    }
  }
  if (!(sum > 0)) return point;
  return {weighted[0] / sum, weighted[1] / sum};
}

bool has_light(const Image& picture) {
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    if (i % 4 != 3 && picture.pixels[i] > 0) return true;
  }
  return false;
}

}  // namespace

std::array<double, 2> find_center(const Image& picture) {
  if (!has_light(picture)) {
    throw DataError("the picture has no light above its sky, expected a galaxy");
  }
  constexpr double shrink = 0.8;
  constexpr double last_fraction = 0.02;  // of the shorter side: a nucleus
  const double shorter = std::min(picture.width, picture.height);
  PixelPlace point = {picture.width / 2.0, picture.height / 2.0};
  point = centroid(picture, point, std::hypot(picture.width, picture.height));
  for (double radius = shorter / 2; radius > std::max(2.0, last_fraction * shorter);
       radius *= shrink) {
    // Twice: the circle follows what it found.
    point = centroid(picture, point, radius);
    point = centroid(picture, point, radius);
  }
  return point;
}

}  // namespace splotchcl
