#pragma once

#include <array>
#include <vector>

#include "device/frame/shared.h"
#include "splotchcl/frame.h"

namespace splotchcl {

// From where in space splats reach what is drawn of a picture, as planes with room for all that the
// projection rounds: what lies beyond one of them certainly makes no splat, bright or sharp.
class ViewBounds {
 public:
  // `p` as the component is projected. Wide angles have no bounds.
  ViewBounds(const Frame& frame, const DrawnComponent& component,
             const shared::ProjectParameters<float>& p);

  // Whether none of a block's good particles makes a splat or is around the camera.
  bool leave_out(const shared::BlockBox& box) const;

 private:
  // normal * (x - camera) + of_sigma * sigma + constant < 0 where sigma is the width in lengths.
  struct Plane {
    std::array<double, 3> normal;
    double of_sigma, constant;
  };
  void add(const Vec3& normal, double of_sigma, double constant);
  void add_edges(const Frame& frame, const shared::ProjectParameters<float>& p);
  void add_limits(const Frame& frame, const shared::ProjectParameters<float>& p);

  std::array<double, 3> camera_;  // from the component's origin
  double sigma_per_h_;
  double around_;  // nearer than so many sigma, clouds are around the camera
  std::vector<Plane> planes_;
};

}  // namespace splotchcl
