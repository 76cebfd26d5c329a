#include "splotchcl/cube.h"

#include <boost/qvm/vec_operations.hpp>

namespace splotchcl {

std::array<CubeFace, 6> cube_faces(const CameraFrame& front) {
  using namespace boost::qvm;
  const Vec3 right = front.right, down = front.down, forward = front.forward;
  const Vec3 left = -right, up = -down, back = -forward;
  const auto face = [&front](const char* name, int column, int row, const Vec3& to_the_right,
                             const Vec3& downwards, const Vec3& ahead) {
    CubeFace face = {name, column, row, front};
    face.camera.right = to_the_right;
    face.camera.down = downwards;
    face.camera.forward = ahead;
    return face;
  };
  return {{face("right", 0, 0, back, down, right), face("left", 1, 0, forward, down, left),
           face("up", 2, 0, right, forward, up), face("down", 0, 1, right, back, down),
           face("front", 1, 1, right, down, forward), face("back", 2, 1, left, down, back)}};
}

}  // namespace splotchcl
