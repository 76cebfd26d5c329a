#include "splotchcl/frame.h"

namespace splotchcl {

DepthChain make_depth_chain(const CameraFrame& camera, const Vec3& origin) {
  DepthChain chain;
  for (int axis = 0; axis < 3; ++axis) {
    const double position = camera.position.a[axis] - origin.a[axis];
    chain.position_high[axis] = static_cast<float>(position);
    chain.position_low[axis] =
        static_cast<float>(position - static_cast<double>(chain.position_high[axis]));
    chain.forward[axis] = static_cast<float>(camera.forward.a[axis]);
  }
  return chain;
}

}  // namespace splotchcl
