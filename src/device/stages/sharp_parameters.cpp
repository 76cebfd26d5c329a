#include "device/stages/sharp_parameters.h"

#include "device/frame/float_pair.h"
#include "scene/projection.h"

namespace splotchcl {
namespace {

void split_in_three(double value, float (&parts)[3]) {
  for (float& part : parts) {
    part = nearest_float(value);
    value -= static_cast<double>(part);
  }
}

void copy(const Vec3& from, shared::FloatPair (&to)[3]) {
  for (int axis = 0; axis < 3; ++axis)
    to[axis] = pair_of(from.a[axis]);
}

}  // namespace

shared::SharpParameters make_sharp_parameters(const StageContext& context,
                                              const DrawnComponent& component) {
  const Frame& frame = context.frame;
  const CameraFrame& camera = frame.camera;
  const shared::Grid& grid = context.layout.grids.front();
  shared::SharpParameters e{};
  for (int axis = 0; axis < 3; ++axis)
    split_in_three(camera.position.a[axis] - component.particles.origin.a[axis], e.position[axis]);
  copy(camera.right, e.right);
  copy(camera.down, e.down);
  copy(camera.forward, e.forward);
  e.pixels_per_length =
      pair_of(frame.projection == Projection::orthographic ? camera.pixels_per_length
                                                           : camera.focal_pixels);
  e.center_from_middle_x = pair_of(camera.center_x - grid.middle_x);
  e.center_from_middle_y = pair_of(camera.center_y - grid.middle_y);
  e.eye_offset = pair_of(camera.eye_offset);
  copy(turn_axis_in_view(camera), e.turn_axis);
  return e;
}

}  // namespace splotchcl
