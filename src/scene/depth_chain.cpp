#include <cmath>

#include "splotchcl/frame.h"

namespace splotchcl {

DepthChain make_depth_chain(const CameraFrame& camera, const Vec3& origin) {
  DepthChain chain;
  for (int axis = 0; axis < 3; ++axis) {
    const double position = camera.position.a[axis] - origin.a[axis];
    // Volatile, since GCC 12 at -O3 takes a vectorised double -> float -> double for the
    // identity, and so finds that nothing is left for the low part.
    const volatile float high = static_cast<float>(position);
    chain.position_high[axis] = high;
    chain.position_low[axis] = static_cast<float>(position - static_cast<double>(high));
    chain.forward[axis] = static_cast<float>(camera.forward.a[axis]);
  }
  chain.inverse_unit =
      static_cast<float>(std::exp2(-std::round(std::log2(camera.look_at_distance))));
  return chain;
}

}  // namespace splotchcl
