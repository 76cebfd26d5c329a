#include "film/follow/point_cloud.h"

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <cstddef>

#include "scene/constants.h"

namespace splotchcl {

using namespace boost::qvm;

Vec3 PointCloud::offset(const Vec3& from, const Vec3& point) const {
  Vec3 way = point - from;
  for (std::size_t axis = 0; axis < 3 && box; ++axis)
    way.a[axis] = nearest_image(way.a[axis], (*box)[axis]);
  return way;
}

namespace {

// Of a cube.
struct Region {
  Vec3 corner;
  double side;
};

Region region_of(const std::vector<Vec3>& points) {
  Vec3 low = points.front(), high = points.front();
  for (const Vec3& point : points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low.a[axis] = std::min(low.a[axis], point.a[axis]);
      high.a[axis] = std::max(high.a[axis], point.a[axis]);
    }
  }
  double side = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    side = std::max(side, high.a[axis] - low.a[axis]);
  return {low, side};
}

constexpr int cells = 16;  // a side

// The cell of a point in the region; nothing outside.
std::optional<std::size_t> cell_of(const Vec3& point, const Region& region) {
  std::size_t cell = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double place = (point.a[axis] - region.corner.a[axis]) / region.side * cells;
    if (!(place >= 0 && place <= cells)) return std::nullopt;
    cell = cell * cells + static_cast<std::size_t>(std::min(place, cells - 1.0));
  }
  return cell;
}

// The fullest cell and half a cell around it.
Region around_fullest(const std::vector<Vec3>& points, const Region& region) {
  std::vector<std::size_t> counts(cells * cells * cells);
  for (const Vec3& point : points) {
    if (const auto cell = cell_of(point, region)) ++counts[*cell];
  }
  auto fullest =
      static_cast<std::size_t>(std::max_element(counts.begin(), counts.end()) - counts.begin());
  const double size = region.side / cells;
  Vec3 corner = region.corner;
  for (std::size_t axis = 3; axis-- > 0; fullest /= cells)
    corner.a[axis] += (static_cast<double>(fullest % cells) - 0.5) * size;
  return {corner, 2 * size};
}

bool is_inside(const Vec3& point, const Region& region) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double place = point.a[axis] - region.corner.a[axis];
    if (!(place >= 0 && place <= region.side)) return false;
  }
  return true;
}

std::vector<Vec3> inside(const std::vector<Vec3>& points, const Region& region) {
  std::vector<Vec3> found;
  for (const Vec3& point : points) {
    if (is_inside(point, region)) found.push_back(point);
  }
  return found;
}

struct Mean {
  Vec3 offset = {{0, 0, 0}};
  std::size_t count = 0;
};
Mean mean_within(const PointCloud& cloud, const Vec3& center, double radius) {
  Mean mean;
  for (const Vec3& point : cloud.points) {
    const Vec3 offset = cloud.offset(center, point);
    if (mag_sqr(offset) > radius * radius) continue;
    mean.offset += offset;
    ++mean.count;
  }
  if (mean.count > 0) mean.offset /= static_cast<double>(mean.count);
  return mean;
}

constexpr std::size_t few = 50;

}  // namespace

Vec3 densest_point(const PointCloud& cloud) {
  Region region = region_of(cloud.points);
  std::vector<Vec3> points = cloud.points;
  const double least = 1e-6 * region.side;
  while (points.size() > 20 * few && region.side > least) {
    region = around_fullest(points, region);
    std::vector<Vec3> closer = inside(points, region);
    if (closer.size() < few) break;
    points = std::move(closer);
  }
  Vec3 center = {{0, 0, 0}};
  for (const Vec3& point : points)
    center += point / static_cast<double>(points.size());
  constexpr double smaller = 0.8;
  for (double radius = region.side; radius > least; radius *= smaller) {
    const Mean mean = mean_within(cloud, center, radius);
    if (mean.count < few) break;
    center += mean.offset;
  }
  return center;
}

namespace {

std::vector<double> distances(const PointCloud& cloud, const Vec3& center) {
  std::vector<double> all;
  all.reserve(cloud.points.size());
  for (const Vec3& point : cloud.points)
    all.push_back(mag(cloud.offset(center, point)));
  return all;
}

double volume_of(const PointCloud& cloud) {
  if (cloud.box) return (*cloud.box)[0] * (*cloud.box)[1] * (*cloud.box)[2];
  const Region region = region_of(cloud.points);
  return region.side * region.side * region.side;
}

double sphere_volume(double radius) {
  return 4.0 / 3.0 * pi * radius * radius * radius;
}

}  // namespace

double dense_radius(const PointCloud& cloud, const Vec3& center) {
  constexpr double contrast = 200;
  std::vector<double> all = distances(cloud, center);
  std::sort(all.begin(), all.end());
  const double mean_density = static_cast<double>(all.size()) / volume_of(cloud);
  std::size_t last = 0;
  for (std::size_t i = few - 1; i < all.size(); ++i) {
    if (static_cast<double>(i + 1) < contrast * mean_density * sphere_volume(all[i])) break;
    last = i;
  }
  if (last == 0) last = std::min(all.size() - 1, std::max(few, all.size() / 100));
  return all[last];
}

double radius_of_part(const PointCloud& cloud, const Vec3& center, double part) {
  std::vector<double> all = distances(cloud, center);
  const auto place = static_cast<std::ptrdiff_t>(part * static_cast<double>(all.size() - 1));
  std::nth_element(all.begin(), all.begin() + place, all.end());
  return all[static_cast<std::size_t>(place)];
}

std::size_t core_count(std::size_t points) {
  constexpr std::size_t enough = 100;
  return std::min(points, std::max(enough, points / 10));
}

Vec3 core_of(const PointCloud& cloud, const Vec3& start, double radius) {
  constexpr double smaller = 0.9;
  const std::size_t least = core_count(cloud.points.size());
  Vec3 core = start;
  for (double within = radius; within > 1e-3 * radius; within *= smaller) {
    const Mean mean = mean_within(cloud, core, within);
    if (mean.count < least || mean.count == 0) break;
    core += mean.offset;
  }
  return core;
}

namespace {

Vec3 median_offset(const PointCloud& cloud, const Vec3& from) {
  std::vector<double> axes[3];
  for (const Vec3& point : cloud.points) {
    const Vec3 offset = cloud.offset(from, point);
    for (std::size_t axis = 0; axis < 3; ++axis)
      axes[axis].push_back(offset.a[axis]);
  }
  Vec3 median;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto middle = axes[axis].begin() + static_cast<std::ptrdiff_t>(axes[axis].size() / 2);
    std::nth_element(axes[axis].begin(), middle, axes[axis].end());
    median.a[axis] = *middle;
  }
  return median;
}

}  // namespace

// Twice, so that in a periodic box all images are those nearest to the middle.
Vec3 middle_of(const PointCloud& cloud, const Vec3& guess) {
  const Vec3 center = guess + median_offset(cloud, guess);
  return center + median_offset(cloud, center);
}

}  // namespace splotchcl
