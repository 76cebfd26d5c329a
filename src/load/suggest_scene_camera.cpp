#include "load/suggest_scene_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/decimals.h"
#include "scene/constants.h"
#include "scene/particle_rules.h"
#include "scene/statistics.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr std::size_t position_limit = 200000;  // looked at, of all types together
constexpr double suggested_degrees = 40;
constexpr Vec3 sky = {{0, 0, 1}};

// From where a target is seen: angles of the line from the target to the camera, about
// the z axis and above the x-y plane.
struct Viewpoint {
  double azimuth_degrees, elevation_degrees;
};

// A box is seen almost along an axis, or its corners stand empty in the picture; a
// little askew, so that filaments along the axes do not hide behind themselves.
constexpr Viewpoint box_viewpoint = {-68, 16};
// Discs lie in the x-y plane more often than not: from here they show their face.
constexpr Viewpoint object_viewpoint = {-60, 42};

// The distance from a box's centre, in sides of the box, at which the picture of 40
// degrees just shows its whole width halfway into the depth.
constexpr double box_distance = 1.25;

// An object is shown as far as it reaches without this part of its particles at either
// end of each axis of the picture, times the margin: a few particles far out would make
// all else small.
constexpr double outliers = 0.05;
constexpr double object_margin = 1.6;

// Coordinates of sampled particles, an array per axis.
using Sample = std::array<std::vector<double>, 3>;

struct Target {
  Vec3 center;
  double size;  // side of a box; half the width of a picture that shows the object
  bool is_box;
};

// Where a halo surrounds discs, bulges or stars, those are what the picture is about.
std::vector<int> types_to_frame(const std::vector<int>& types) {
  std::vector<int> bright;
  std::copy_if(types.begin(), types.end(), std::back_inserter(bright),
               [](int type) { return type == 0 || (type >= 2 && type <= 4); });
  return bright.empty() ? types : bright;
}

void sample_type(const Snapshot& snapshot, int type, std::size_t stride, Sample& sample) {
  const Column position = snapshot.read(type, "position");
  const Vec3 origin = snapshot.position_origin();
  for (std::size_t i = 0; i + 2 < position.size(); i += 3 * stride) {
    if (!is_finite_position(position.data() + i)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sample[axis].push_back(origin.a[axis] + static_cast<double>(position[i + axis]));
    }
  }
}

Sample sample_positions(const Snapshot& snapshot, const std::vector<int>& types) {
  std::size_t count = 0;
  for (const int type : types) {
    const ParticleTypeInfo* const info = snapshot.info().find_type(type);
    if (info != nullptr) count += static_cast<std::size_t>(info->count);
  }
  Sample sample;
  for (const int type : types) {
    if (snapshot.info().find_type(type) == nullptr) continue;
    sample_type(snapshot, type, sample_stride(count, position_limit), sample);
  }
  if (sample[0].empty()) {
    throw DataError(fmt::format(
        "{}: found no particle at a finite position among those to be drawn, expected some; set "
        "camera and types in a scene file",
        snapshot.info().files.front().string()));
  }
  return sample;
}

Vec3 direction(const Viewpoint& viewpoint) {
  const double azimuth = viewpoint.azimuth_degrees * pi / 180;
  const double elevation = viewpoint.elevation_degrees * pi / 180;
  return {{std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation),
           std::sin(elevation)}};
}

ValueRange extent(std::vector<double>& values, double left_out) {
  return {percentile(values, left_out), percentile(values, 1 - left_out)};
}

// Particles that fill a cube to its faces are a box, also where the header has no size:
// 90 % of the particles then span 90 % of the extent, on every axis, where those of an
// object are concentrated.
std::optional<Target> find_cube(Sample& sample) {
  Target cube{{{0, 0, 0}}, 0, true};
  double smallest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const ValueRange all = extent(sample[axis], 0);
    const ValueRange most = extent(sample[axis], 0.05);
    const double side = all.maximum - all.minimum;
    if (!(most.maximum - most.minimum > 0.83 * side)) return std::nullopt;
    cube.center.a[axis] = 0.5 * (all.minimum + all.maximum);
    cube.size = std::max(cube.size, side);
    smallest = axis == 0 ? side : std::min(smallest, side);
  }
  if (smallest < 0.9 * cube.size) return std::nullopt;
  return cube;
}

// The box of the header, where the particles are spread over it.
std::optional<Target> find_periodic_box(Sample& sample, const SnapshotInfo& info) {
  if (!info.box_size || !(*info.box_size > 0)) return std::nullopt;
  const double side = *info.box_size;
  bool reaches_below_zero = false;
  for (std::vector<double>& values : sample) {
    const ValueRange most = extent(values, 0.01);
    if (most.maximum - most.minimum < 0.7 * side) return std::nullopt;
    reaches_below_zero = reaches_below_zero || most.minimum < -0.1 * side;
  }
  // Some programs put the middle of the box at the origin.
  const double middle = reaches_below_zero ? 0 : 0.5 * side;
  return Target{{{middle, middle, middle}}, side, true};
}

// What an object spans as seen from its viewpoint, along the picture's axes.
Target find_object(const Sample& sample, double aspect) {
  using namespace boost::qvm;
  const Vec3 towards_camera = direction(object_viewpoint);
  const Vec3 right = normalized(cross(sky, towards_camera));
  const Vec3 up = cross(towards_camera, right);
  const auto span_along = [&sample](const Vec3& axis) {
    std::vector<double> along;
    for (std::size_t i = 0; i < sample[0].size(); ++i) {
      along.push_back(sample[0][i] * axis.a[0] + sample[1][i] * axis.a[1] +
                      sample[2][i] * axis.a[2]);
    }
    return extent(along, outliers);
  };
  const auto middle = [](const ValueRange& r) { return 0.5 * (r.minimum + r.maximum); };
  const auto half = [](const ValueRange& r) { return 0.5 * (r.maximum - r.minimum); };
  const ValueRange across = span_along(right);
  const ValueRange upwards = span_along(up);
  const ValueRange depth = span_along(towards_camera);
  const double size = std::max(half(across), half(upwards) / aspect);
  Target object;
  object.center = middle(across) * right + middle(upwards) * up + middle(depth) * towards_camera;
  // A single particle, or all in one place: any size will do.
  object.size = size > 0 ? size : 1.0;
  object.is_box = false;
  return object;
}

Target find_target(Sample& sample, const SnapshotInfo& info, double aspect) {
  // An object needs the coordinates of a particle together, and percentiles of an axis
  // change their order: it looks first.
  const Target object = find_object(sample, aspect);
  if (const auto box = find_periodic_box(sample, info)) return *box;
  if (const auto cube = find_cube(sample)) return *cube;
  return object;
}

// A number that reads well in a scene file: four digits of the size of the target.
double rounded(double value, double size) {
  return round_to_decimals(value, decimals_for(size, 4));
}

}  // namespace

Camera suggest_camera(const Snapshot& snapshot, const std::vector<int>& types, int width,
                      int height) {
  using namespace boost::qvm;
  Sample sample = sample_positions(snapshot, types_to_frame(types));
  const double aspect = static_cast<double>(height) / width;
  const Target target = find_target(sample, snapshot.info(), aspect);
  const double half_angle = 0.5 * suggested_degrees * pi / 180;
  const double distance = target.is_box ? box_distance * target.size
                                        : object_margin * target.size / std::tan(half_angle);
  const Vec3 towards_camera = direction(target.is_box ? box_viewpoint : object_viewpoint);

  Camera camera;
  camera.field_of_view_degrees = suggested_degrees;
  camera.sky = sky;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    camera.look_at.a[axis] = rounded(target.center.a[axis], target.size);
    camera.position.a[axis] =
        rounded(target.center.a[axis] + distance * towards_camera.a[axis], target.size);
  }
  return camera;
}

}  // namespace splotchcl
