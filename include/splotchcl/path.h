#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "splotchcl/vector.h"

namespace splotchcl {

// What a scene's keys are at one frame of a film; they are interpolated in between. Each
// key follows the keyframes that name it, whatever the others do.
struct Keyframe {
  double frame = 0;  // >= 0, counted from 0
  // Values by scene key ("camera.position", "component.gas.brightness"), as in a scene file.
  std::map<std::string, std::string> values;
};

// The camera, its look-at point and its sky turn about an axis, counterclockwise seen from
// the axis' tip. A turn of 360 degrees over n frames leaves out the n-th, the first again.
struct Orbit {
  double degrees = 360;
  std::optional<Vec3> center;    // unset: the look-at point
  std::optional<Vec3> axis;      // unset: the sky
  std::optional<double> radius;  // from the center to the camera, > 0; unset: as it stands
};

// The camera flies through points at constant speed, looking ahead.
struct FlyThrough {
  std::vector<Vec3> through;    // at least two
  std::optional<Vec3> look_at;  // looks at this point instead
  bool is_eased = false;        // speeds up in the beginning and slows down in the end
};

// How a scene changes over the frames of a film. At most one of file, orbit and fly moves
// the camera; keyframes move it, or change anything beside it.
struct PathSettings {
  // What keyframes' directions are:
  //   point      the look-at point moves from one to the next
  //   direction  the view turns from one to the next, and its distance changes
  enum class Look { point, direction };

  std::string file;  // a row of values per frame; empty: none
  std::optional<Orbit> orbit;
  std::optional<FlyThrough> fly;
  std::vector<Keyframe> keyframes;  // in increasing order of their frames
  bool is_smooth = true;            // false: straight lines between keyframes
  Look look = Look::point;

  // Whether there is anything that changes.
  bool is_set() const { return !file.empty() || orbit || fly || !keyframes.empty(); }
};

}  // namespace splotchcl
