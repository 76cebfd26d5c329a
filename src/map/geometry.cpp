#include "map/geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "load/placement.h"
#include "scene/constants.h"
#include "scene/particle_rules.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using namespace boost::qvm;

const Camera& camera_of(const Scene& scene) {
  if (scene.camera) return *scene.camera;
  throw UsageError("key map.view: found \"camera\", but the scene has none; add a [camera]");
}

void set_axes(const Scene& scene, MapGeometry& geometry) {
  const Vec3 x = {{1, 0, 0}}, y = {{0, 1, 0}}, z = {{0, 0, 1}};
  switch (scene.map.view) {
    case MapView::xy:
    case MapView::sky:  // by its own center and pixels
      geometry.right = x, geometry.up = y;
      break;
    case MapView::xz:
      geometry.right = x, geometry.up = z;
      break;
    case MapView::yz:
      geometry.right = y, geometry.up = z;
      break;
    case MapView::camera: {
      const CameraFrame frame =
          make_camera_frame(camera_of(scene), geometry.width, geometry.height);
      geometry.right = frame.right, geometry.up = -frame.down;
      break;
    }
  }
  geometry.forward = cross(geometry.up, geometry.right);
}

struct Extent {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
  void take(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  double middle() const { return 0.5 * (least + most); }
  double span() const { return most - least; }
};

Extent extent_along(const MapMatter& matter, const Vec3& axis) {
  Extent extent;
  for (std::size_t i = 0; i < matter.count; ++i) {
    if (matter.is_good(i)) extent.take(dot(matter.position_of(i), axis));
  }
  if (extent.most < extent.least) {
    throw DataError(
        "found no particle with a finite position and a size > 0, expected some to map");
  }
  return extent;
}

double mass_of(const MapMatter& matter, std::size_t i) {
  const double mass = matter.mass.is_absent() ? 1 : static_cast<double>(matter.mass[i]);
  return std::isfinite(mass) && mass > 0 ? mass : 0;
}

// Where the mean of the angles lies that coordinates are in a periodic box.
Vec3 center_of_angles(const MapMatter& matter, const BoxSides& box) {
  Vec3 cosines = {{0, 0, 0}}, sines = {{0, 0, 0}};
  for (std::size_t i = 0; i < matter.count; ++i) {
    if (!matter.is_good(i)) continue;
    const double mass = mass_of(matter, i);
    const Vec3 position = matter.position_of(i);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cosines.a[axis] += mass * std::cos(2 * pi * position.a[axis] / box[axis]);
      sines.a[axis] += mass * std::sin(2 * pi * position.a[axis] / box[axis]);
    }
  }
  Vec3 center;
  for (std::size_t axis = 0; axis < 3; ++axis)
    center.a[axis] = box[axis] * std::atan2(sines.a[axis], cosines.a[axis]) / (2 * pi);
  return center;
}

// In a periodic box each particle counts where it is nearest to the mean of the angles, so that
// what lies across a face has its center at the face.
Vec3 center_of_mass(const MapMatter& matter, const std::optional<BoxSides>& box) {
  Vec3 first = {{0, 0, 0}}, sum = {{0, 0, 0}};
  if (box) first = center_of_angles(matter, *box);
  double total = 0;
  for (std::size_t i = 0; i < matter.count; ++i) {
    if (!matter.is_good(i)) continue;
    const double mass = mass_of(matter, i);
    Vec3 offset = matter.position_of(i) - first;
    for (std::size_t axis = 0; axis < 3 && box; ++axis)
      offset.a[axis] = nearest_image(offset.a[axis], (*box)[axis]);
    total += mass;
    sum += mass * offset;
  }
  if (!(total > 0)) {
    throw DataError("key map.center_at: found no mass above 0, expected some; set map.center");
  }
  Vec3 center = first + sum / total;
  for (std::size_t axis = 0; axis < 3 && box; ++axis)
    center.a[axis] -= (*box)[axis] * std::floor(center.a[axis] / (*box)[axis]);
  return center;
}

Vec3 densest_place(const MapMatter& matter) {
  double most = 0;
  Vec3 place = {{0, 0, 0}};
  for (std::size_t i = 0; i < matter.count; ++i) {
    if (!matter.is_good(i)) continue;
    // Lengths often have a least one, at which all dense particles would be alike.
    const double density = matter.density.is_absent()
                               ? mass_of(matter, i) / std::pow(matter.size_of(i), 3)
                               : static_cast<double>(matter.density[i]);
    if (!(density > most && std::isfinite(density))) continue;
    most = density;
    place = matter.position_of(i);
  }
  if (most > 0) return place;
  throw DataError("key map.center_at: found no density above 0, expected some; set map.center");
}

// The axis itself of what looks along one; else the nearest.
std::size_t nearest_axis(const Vec3& direction) {
  std::size_t nearest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (std::abs(direction.a[axis]) > std::abs(direction.a[nearest])) nearest = axis;
  }
  return nearest;
}

double side_along(const BoxSides& box, const Vec3& direction) {
  return box[nearest_axis(direction)];
}

// Or else the particles, where there is no box, or they are a part that was cut out of it.
bool shows_box(const PeriodicRegion& region, const MapMatter& matter, const MapGeometry& geometry) {
  if (!region.box || matter.count == 0) return region.box.has_value();
  return fills_box(region.extent, *region.box, nearest_axis(geometry.right)) ||
         fills_box(region.extent, *region.box, nearest_axis(geometry.up));
}

Vec3 choose_center(const Scene& scene, const MapMatter& matter, const PeriodicRegion& region,
                   const MapGeometry& geometry) {
  const MapSettings& map = scene.map;
  if (map.center) return *map.center;
  if (map.center_at == MapCenter::mass) return center_of_mass(matter, geometry.box);
  if (map.center_at == MapCenter::densest) return densest_place(matter);
  if (map.view == MapView::camera) return camera_of(scene).look_at;
  if (shows_box(region, matter, geometry)) return middle_of_period(region.extent, *region.box);
  return extent_along(matter, geometry.right).middle() * geometry.right +
         extent_along(matter, geometry.up).middle() * geometry.up +
         extent_along(matter, geometry.forward).middle() * geometry.forward;
}

double choose_width(const Scene& scene, const MapMatter& matter, const PeriodicRegion& region,
                    const MapGeometry& geometry) {
  if (scene.map.width) return *scene.map.width;
  if (scene.map.view == MapView::camera) {
    const CameraFrame frame = make_camera_frame(camera_of(scene), geometry.width, geometry.height);
    return geometry.width / frame.pixels_per_length;
  }
  const double aspect = static_cast<double>(geometry.width) / geometry.height;
  if (shows_box(region, matter, geometry)) {
    return std::max(side_along(*region.box, geometry.right),
                    side_along(*region.box, geometry.up) * aspect);
  }
  const double width = std::max(extent_along(matter, geometry.right).span(),
                                extent_along(matter, geometry.up).span() * aspect);
  if (width > 0) return width;
  throw UsageError("key map.width: all particles lie in one place, expected a width");
}

// Nothing can be found by particles that a selection leaves out.
void check_place_without_matter(const MapSettings& map, const MapMatter& matter, bool has_box) {
  const bool is_by_camera = map.view == MapView::camera;
  const bool has_center =
      map.center || (map.center_at == MapCenter::box && (has_box || is_by_camera));
  const bool has_width = map.width || has_box || is_by_camera;
  if (has_center && has_width) return;
  throw UsageError(fmt::format(
      "keys map.center and map.width: select and exclude leave none of {} particles, expected some "
      "to find the map's place by; set {}{}{}",
      matter.before_selecting, has_center ? "" : "map.center",
      has_center || has_width ? "" : " and ", has_width ? "" : "map.width"));
}

}  // namespace

Vec3 MapMatter::position_of(std::size_t i) const {
  Vec3 place = origin;
  for (std::size_t axis = 0; axis < 3; ++axis)
    place.a[axis] += static_cast<double>(position[3 * i + axis]);
  return place;
}

bool MapMatter::is_good(std::size_t i) const {
  return is_finite_position(position.data() + 3 * i) && is_smoothing_length(smoothing_length[i]);
}

PeriodicRegion find_region(const Scene& scene, const Component& component, const Snapshot& snapshot,
                           std::vector<std::string>& notes) {
  const SnapshotInfo& info = snapshot.info();
  PeriodicRegion region;
  region.box = scene.periodic.box ? scene.periodic.box : info.box_size;
  const bool is_placed = !is_in_the_box(component);
  if (!scene.map.periodic.value_or(region.box && !is_placed)) return {};
  if (is_placed) {
    throw UsageError(
        "key map.periodic: found true, but the component is placed outside of the box, expected "
        "one without a snapshot or a placement of its own");
  }
  if (!region.box) {
    throw UsageError("key map.periodic: found true, but " + info.files.front().string() +
                     " does not say the size of a box, expected one; set periodic.box");
  }
  region.extent = find_extent(snapshot, component.types);
  const bool is_said = scene.map.periodic || scene.periodic.box;
  if (is_said || lies_in_one_period(region.extent, *region.box)) return region;
  notes.push_back(tell_box_is_not_used(*region.box, region.extent) +
                  "; set map.periodic to true if they are");
  return {};
}

std::vector<Vec3> images_within(const Vec3& offset, double reach,
                                const std::optional<BoxSides>& box) {
  if (!box) return {offset};
  std::array<double, 3> first{}, last{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    first[axis] = std::ceil((-reach - offset.a[axis]) / (*box)[axis]);
    last[axis] = std::floor((reach - offset.a[axis]) / (*box)[axis]);
  }
  std::vector<Vec3> images;
  for (double x = first[0]; x <= last[0]; ++x) {
    for (double y = first[1]; y <= last[1]; ++y) {
      for (double z = first[2]; z <= last[2]; ++z)
        images.push_back(offset + Vec3{{x * (*box)[0], y * (*box)[1], z * (*box)[2]}});
    }
  }
  return images;
}

void check_images(double reach, const std::optional<BoxSides>& box, const std::string& what) {
  if (!box) return;
  const double boxes = 2 * reach / std::min({(*box)[0], (*box)[1], (*box)[2]});
  if (boxes <= most_boxes) return;
  throw UsageError(
      fmt::format("{}: reaches over {:.6g} periodic boxes, expected at most {:.0f}; make it "
                  "smaller, or set map.periodic to false",
                  what, boxes, most_boxes));
}

MapGeometry decide_geometry(const Scene& scene, const MapMatter& matter,
                            const PeriodicRegion& region) {
  MapGeometry geometry;
  geometry.width = scene.image.width;
  geometry.height = scene.image.height;
  geometry.box = region.box;
  set_axes(scene, geometry);
  if (matter.count == 0) check_place_without_matter(scene.map, matter, region.box.has_value());
  geometry.center = choose_center(scene, matter, region, geometry);
  const double width = choose_width(scene, matter, region, geometry);
  geometry.pixel = width / geometry.width;
  geometry.depth = scene.map.depth;
  if (!geometry.box) return geometry;
  if (!geometry.depth) geometry.depth = side_along(*geometry.box, geometry.forward);
  const double boxes =
      std::max({width / side_along(*geometry.box, geometry.right),
                geometry.pixel * geometry.height / side_along(*geometry.box, geometry.up),
                *geometry.depth / side_along(*geometry.box, geometry.forward)});
  if (boxes <= most_boxes) return geometry;
  throw UsageError(fmt::format(
      "key map.width: the map reaches over {:.6g} times the periodic box, "
      "expected at most {:.0f}; make map.width or map.depth smaller, or set map.periodic to false",
      boxes, most_boxes));
}

}  // namespace splotchcl
