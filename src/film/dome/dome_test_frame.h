#pragma once

#include "splotchcl/camera.h"
#include "splotchcl/image.h"

namespace splotchcl {

// A direction under a dome, in degrees: azimuth 0 in front of the audience, which is at the bottom
// of the picture, and 90 to its right; altitude 0 at the rim of 180 degrees and 90 at the zenith.
struct DomePlace {
  double azimuth = 0, altitude = 0;
};
// What a fisheye shows at a place of the picture, in pixels.
DomePlace dome_place_at(double x, double y, const CameraFrame& camera);

// What a projectionist sees whether all of the dome is there, upright and in its place by: rings
// of altitude every 5 degrees and lines of azimuth every 10, in front in red, to the right in
// green and to the left in blue, the names of the sides to be read from the middle of the dome,
// and a cross at the look-at point. `camera` is the fisheye's frame for this size, of a camera
// that sees so many degrees across. Throws UsageError where there is no font.
Image draw_dome_test_frame(const Camera& camera, int width, int height);

}  // namespace splotchcl
