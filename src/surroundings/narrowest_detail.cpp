#include "surroundings/narrowest_detail.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/projection.h"

namespace splotchcl {
namespace {

double distance(const Vec3& a, const Vec3& b) {
  return std::hypot(a.a[0] - b.a[0], a.a[1] - b.a[1], a.a[2] - b.a[2]);
}

// Of those all over the picture, its middle and corners among them, in radians.
double widest_pixel(const Frame& frame) {
  constexpr int steps = 16;
  const auto towards = [&frame](double x, double y) {
    return direction_at(x, y, frame.camera, frame.projection);
  };
  double widest = 0;
  for (int row = 0; row <= steps; ++row) {
    for (int column = 0; column <= steps; ++column) {
      const double x = (frame.width - 1.0) * column / steps;
      const double y = (frame.height - 1.0) * row / steps;
      const Vec3 corner = towards(x, y);
      widest = std::max(
          {widest, distance(corner, towards(x + 1, y)), distance(corner, towards(x, y + 1))});
    }
  }
  return widest;
}

// Whether a disc of this radius in sigma reaches pixels of the picture.
bool is_in_picture(const SplatAround& disc, double radius, const Frame& frame) {
  const auto reaches = [radius](double place, double sigma, int pixels) {
    return place + radius * sigma > 0 && place - radius * sigma < pixels;
  };
  return reaches(disc.x, disc.sigma_x, frame.width) && reaches(disc.y, disc.sigma_y, frame.height);
}

// Nothing between the pixels tells where a disc ends.
constexpr double single_pixels = 0.5;

bool ends_in_picture(const SplatAround& splat, const Frame& frame) {
  return frame.kernel.cut && is_in_picture(splat, *frame.kernel.cut, frame);
}

bool ends_in_picture(const CloudAround& cloud, const Frame& frame) {
  return std::any_of(cloud.splats.begin(), cloud.splats.end(),
                     [&frame](const SplatAround& splat) { return ends_in_picture(splat, frame); });
}

double narrowest_of(const SplatAround& splat, const Frame& frame) {
  if (ends_in_picture(splat, frame)) return single_pixels;
  return std::min(splat.sigma_x, splat.sigma_y);
}

}  // namespace

double narrowest_detail(const std::vector<CloudAround>& clouds, std::size_t first, std::size_t end,
                        const Frame& frame) {
  double farthest = 1, narrowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = first; i < end; ++i) {
    const CloudAround& cloud = clouds[i];
    const Vec3& center = cloud.center;
    if (cloud.ray > 0)
      farthest = std::max(farthest, std::hypot(center.a[0], center.a[1], center.a[2]));
    for (const SplatAround& splat : cloud.splats)
      narrowest = std::min(narrowest, narrowest_of(splat, frame));
  }
  return std::min(narrowest, 1 / (farthest * widest_pixel(frame)));
}

std::vector<std::size_t> ends_of_stretches(const std::vector<CloudAround>& clouds,
                                           std::size_t first, std::size_t end, const Frame& frame) {
  // To work fewer out in every pixel takes no longer than to lay one more picture behind the
  // others.
  constexpr std::size_t fewest = 4;
  std::vector<std::size_t> ends;
  std::size_t begin = first;   // of the clouds since the last end
  std::size_t smooth = first;  // of those since the last whose kernel ends in the picture
  for (std::size_t i = first; i < end; ++i) {
    if (!ends_in_picture(clouds[i], frame)) continue;
    if (i - smooth >= fewest) {
      if (smooth > begin) ends.push_back(smooth);
      ends.push_back(i);
      begin = i;
    }
    smooth = i + 1;
  }
  if (smooth > begin && end - smooth >= fewest) ends.push_back(smooth);
  ends.push_back(end);
  return ends;
}

}  // namespace splotchcl
