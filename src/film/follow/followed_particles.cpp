#include "film/follow/followed_particles.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <cstddef>
#include <memory>
#include <set>
#include <string>

#include "load/placement.h"
#include "load/select_particles.h"
#include "load/type_fields.h"
#include "scene/ceil_divide.h"
#include "scene/constants.h"
#include "scene/particle_columns.h"
#include "snapshot/field_names.h"
#include "splotchcl/error.h"

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

namespace {

// Those that the scene draws of its own snapshot.
std::set<int> types_of(const Scene& scene, const Snapshot& snapshot) {
  std::set<int> types;
  for (const Component& component : scene.components) {
    for (const int type : component.types) {
      if (is_in_the_box(component) && snapshot.info().find_type(type) != nullptr)
        types.insert(type);
    }
  }
  return types;
}

std::uint64_t count_drawn(const Scene& scene, const Snapshot& snapshot) {
  std::uint64_t count = 0;
  for (const int type : types_of(scene, snapshot))
    count += snapshot.info().find_type(type)->count;
  return count;
}

// Particles and where each is among those of its type.
struct Candidates {
  PointCloud cloud;
  std::vector<std::size_t> places;
  std::vector<int> types;
};

Vec3 vector_at(const Column& column, std::size_t i) {
  const ColumnStretch axes(column, 3 * i, 3 * i + 3);
  return {{static_cast<double>(axes[3 * i]), static_cast<double>(axes[3 * i + 1]),
           static_cast<double>(axes[3 * i + 2])}};
}

// Of those that are chosen, or else of all, every `step`-th.
void add(const Snapshot& snapshot, int type, const ParticleIndices* chosen, std::size_t step,
         Candidates& all) {
  const Column position = snapshot.read(type, "position");
  const Vec3 origin = snapshot.position_origin();
  const std::size_t count = chosen != nullptr ? chosen->size() : position.size() / 3;
  for (std::size_t i = 0; i < count; i += step) {
    const std::size_t place = chosen != nullptr ? (*chosen)[i] : i;
    const Vec3 point = origin + vector_at(position, place);
    if (!std::isfinite(boost::qvm::mag(point))) continue;
    all.cloud.points.push_back(point);
    all.places.push_back(place);
    all.types.push_back(type);
  }
}

// All that is drawn, or those of a halo or a sphere; of them every `step`-th.
Candidates candidates(const Scene& scene, const Snapshot& snapshot, const ParticleSet& set,
                      std::size_t step = 1) {
  Candidates all;
  all.cloud.box = filled_box(scene, snapshot);
  Component selecting;
  selecting.select = set;
  for (const int type : types_of(scene, snapshot)) {
    const TypeFields fields(snapshot, *snapshot.info().find_type(type), "path.follow", {{0, 0, 0}},
                            [](const std::string&) {});
    const auto chosen = select_particles(selecting, fields, snapshot, all.cloud.box);
    add(snapshot, type, chosen.get(), step, all);
  }
  return all;
}

[[noreturn]] void refuse_empty(const Follow& follow, const Snapshot& snapshot) {
  throw UsageError(fmt::format(
      "path.follow: found no particle that the scene draws in the {} in {}, expected some",
      follow.halo ? fmt::format("halo {}", *follow.halo) : "sphere",
      snapshot.info().files.front().string()));
}

// A halo's center is the median of its particles, and its radius holds nearly all.
void measure_halo(const Candidates& members, FollowedParticles& followed) {
  constexpr double nearly_all = 0.9;
  followed.center = middle_of(members.cloud, members.cloud.points.front());
  followed.radius = radius_of_part(members.cloud, followed.center, nearly_all);
}

ParticleSet sphere_of(const Scene& scene, const Snapshot& snapshot) {
  const Follow& follow = *scene.path.follow;
  ParticleSet sphere;
  sphere.sphere_center = follow.sphere_center;
  sphere.sphere_radius = follow.sphere_radius;
  if (follow.sphere_center && follow.sphere_radius) return sphere;
  // The densest place is where it is among a part of so many.
  constexpr std::uint64_t most_looked_at = std::uint64_t{1} << 22;
  const auto step = static_cast<std::size_t>(
      ceil_divide(std::max<std::uint64_t>(1, count_drawn(scene, snapshot)), most_looked_at));
  const Candidates all = candidates(scene, snapshot, {}, step);
  if (all.cloud.points.empty()) refuse_empty(follow, snapshot);
  if (!sphere.sphere_center) sphere.sphere_center = densest_point(all.cloud);
  if (!sphere.sphere_radius) sphere.sphere_radius = dense_radius(all.cloud, *sphere.sphere_center);
  return sphere;
}

void keep_ids(const Candidates& all, const Snapshot& snapshot, FollowedParticles& followed) {
  std::map<int, std::vector<std::uint64_t>> ids_of_type;
  for (std::size_t i = 0; i < all.places.size(); ++i) {
    const int type = all.types[i];
    if (ids_of_type.count(type) == 0) ids_of_type[type] = snapshot.read_ids(type);
    followed.ids[type].push_back(ids_of_type[type].at(all.places[i]));
  }
  for (auto& [type, ids] : followed.ids)
    std::sort(ids.begin(), ids.end());
}

}  // namespace

std::optional<BoxSides> filled_box(const Scene& scene, const Snapshot& snapshot) {
  const std::optional<BoxSides> box =
      scene.periodic.box ? scene.periodic.box : snapshot.info().box_size;
  if (!box || !box->are_lengths()) return std::nullopt;
  PositionExtent extent;
  for (const int type : types_of(scene, snapshot))
    extent.take(extent_of_type(snapshot, type));
  if (!lies_in_one_period(extent, *box)) return std::nullopt;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!fills_box(extent, *box, axis)) return std::nullopt;
  }
  return box;
}

FollowedParticles choose_followed(const Scene& scene, const Snapshot& snapshot, bool wants_ids) {
  const Follow& follow = *scene.path.follow;
  ParticleSet set;
  if (follow.halo) {
    set.halo = follow.halo;
    set.halo_catalog = follow.catalog;
  } else {
    set = sphere_of(scene, snapshot);
  }
  const Candidates members = candidates(scene, snapshot, set);
  if (members.cloud.points.empty()) refuse_empty(follow, snapshot);
  FollowedParticles followed;
  if (follow.halo) {
    measure_halo(members, followed);
  } else {
    followed.radius = *set.sphere_radius;
    followed.center = core_of(members.cloud, *set.sphere_center, followed.radius);
  }
  if (wants_ids) keep_ids(members, snapshot, followed);
  return followed;
}

FoundParticles find_particles(const FollowedParticles& followed, const Snapshot& snapshot,
                              bool wants_velocities) {
  FoundParticles found;
  std::size_t first = 0;  // of a type, among all
  for (const auto& [type, wanted] : followed.ids) {
    const std::size_t first_of_type = first;
    first += wanted.size();
    if (snapshot.info().find_type(type) == nullptr) continue;
    const std::vector<std::uint64_t> ids = snapshot.read_ids(type);
    const Column position = snapshot.read(type, "position");
    const Column velocity = wants_velocities ? snapshot.read(type, "velocity") : Column();
    const Vec3 origin = snapshot.position_origin();
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const auto place = std::lower_bound(wanted.begin(), wanted.end(), ids[i]);
      if (place == wanted.end() || *place != ids[i]) continue;
      const Vec3 point = origin + vector_at(position, i);
      if (!std::isfinite(boost::qvm::mag(point))) continue;
      found.cloud.points.push_back(point);
      found.numbers.push_back(first_of_type + static_cast<std::size_t>(place - wanted.begin()));
      if (wants_velocities) found.velocities.push_back(vector_at(velocity, i));
    }
  }
  if (!found.cloud.points.empty()) return found;
  throw UsageError(fmt::format(
      "path.follow: found none of the particles that are followed in {}, expected some; choose "
      "them in a snapshot that shares particles with it, by path.follow.snapshot",
      snapshot.info().files.front().string()));
}

}  // namespace splotchcl
