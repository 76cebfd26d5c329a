#include "load/suggest_scene_camera.h"

#include <algorithm>
#include <cmath>

#include "common/decimals.h"
#include "scene/constants.h"

namespace splotchcl {
namespace {

constexpr double suggested_degrees = 40;

// The distance from a box's centre, in sides of the box, at which the picture of 40
// degrees just shows its whole width halfway into the depth.
constexpr double box_distance = 1.25;

// Where a halo surrounds discs, bulges or stars, those are what the picture is about.
std::vector<int> types_to_frame(const std::vector<int>& types) {
  std::vector<int> bright;
  std::copy_if(types.begin(), types.end(), std::back_inserter(bright),
               [](int type) { return type == 0 || (type >= 2 && type <= 4); });
  return bright.empty() ? types : bright;
}

// A number that reads well in a scene file: four digits of the size of the target.
double rounded(double value, double size) {
  return round_to_decimals(value, decimals_for(size, 4));
}

}  // namespace

Target suggest_target(const Snapshot& snapshot, const std::vector<int>& types, int width,
                      int height) {
  return find_target(snapshot, types_to_frame(types), static_cast<double>(height) / width);
}

Camera suggest_camera(const Target& target) {
  const double half_angle = 0.5 * suggested_degrees * pi / 180;
  const double distance = target.shape == Target::Shape::box ? box_distance * target.size
                                                             : target.size / std::tan(half_angle);
  Camera camera;
  camera.field_of_view_degrees = suggested_degrees;
  camera.sky = target.sky;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    camera.look_at.a[axis] = rounded(target.center.a[axis], target.size);
    camera.position.a[axis] =
        rounded(target.center.a[axis] + distance * target.towards_camera.a[axis], target.size);
  }
  return camera;
}

}  // namespace splotchcl
