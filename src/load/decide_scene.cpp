#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <cstddef>

#include "scene/constants.h"
#include "scene/reference_column.h"
#include "scene/scalar_map.h"
#include "splotchcl/load.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {
namespace {

bool is_decided(const FieldMap& map) {
  return map.field.empty() || (map.minimum && map.maximum);
}

// A scene without a camera is drawn in perspective by the camera that load_frame chose.
Camera camera_of(const Frame& frame) {
  using namespace boost::qvm;
  const CameraFrame& from = frame.camera;
  Camera camera;
  camera.position = from.position;
  camera.look_at = from.position + from.look_at_distance * from.forward;
  camera.sky = -from.down;
  camera.field_of_view_degrees = 2 * std::atan(0.5 * frame.width / from.focal_pixels) * 180 / pi;
  camera.projection = frame.projection;
  camera.near_limit = frame.near_limit;
  camera.far_limit = frame.far_limit;
  return camera;
}

void decide(FieldMap& map, const ScalarMap& decided) {
  if (is_decided(map)) return;
  if (!map.minimum) map.minimum = unscaled(decided.minimum, map.scaling);
  if (!map.maximum) map.maximum = unscaled(decided.maximum, map.scaling);
  map.percentiles.reset();
}

}  // namespace

Scene decide_scene(const Scene& scene, const Frame& frame) {
  Scene decided = scene;
  if (!decided.camera) decided.camera = camera_of(frame);
  for (std::size_t i = 0; i < decided.components.size(); ++i) {
    Component& component = decided.components[i];
    const DrawnComponent& drawn = frame.components.at(i);
    if (!component.weight) component.weight = drawn.weight;
    if (drawn.particles.count == 0) continue;
    decide(component.color, drawn.color);
    decide(component.intensity, drawn.intensity);
    if (!component.reference_column && find_reference_column(drawn, frame)) {
      component.reference_column = drawn.reference_column * drawn.particles_per_drawn;
    }
  }
  return decided;
}

bool is_decided(const Scene& scene) {
  const bool has_all =
      std::all_of(scene.components.begin(), scene.components.end(), [](const Component& component) {
        return component.weight && component.reference_column && is_decided(component.color) &&
               is_decided(component.intensity);
      });
  return scene.camera && has_all;
}

}  // namespace splotchcl
