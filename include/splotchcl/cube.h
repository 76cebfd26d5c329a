#pragma once

#include <array>

#include "splotchcl/camera.h"

namespace splotchcl {

// One face of the cube around the camera, and its place in the sheet of 3 x 2 faces: columns
// from the left and rows from the top, from 0.
struct CubeFace {
  const char* name;  // front, right, ...
  int column, row;
  CameraFrame camera;
};

// From the camera whose view is the middle of the front face. Side faces have its upward
// direction; the lower edge of the upper face and the upper edge of the lower one meet the
// front face.
std::array<CubeFace, 6> cube_faces(const CameraFrame& front);

}  // namespace splotchcl
