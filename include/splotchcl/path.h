#pragma once

#include <cstdint>
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
  // Of the keys that it names: they slow down until they stop here, and start again slowly.
  bool is_eased = false;
  double dwell = 0;  // so many frames they stay; above 0 they are eased, too
};

// The camera, its look-at point and its sky turn about an axis, counterclockwise seen from
// the axis' tip. A turn of 360 degrees over n frames leaves out the n-th, the first again.
struct Orbit {
  double degrees = 360;
  std::optional<Vec3> center;    // unset: the look-at point
  std::optional<Vec3> axis;      // unset: the sky
  std::optional<double> radius;  // from the center to the camera, > 0; unset: as it stands
  // Turns faster and faster in the beginning and slows down in the end, and arrives at the end with
  // the last frame.
  bool is_eased = false;
};

// The camera flies through points at constant speed, looking ahead.
struct FlyThrough {
  std::vector<Vec3> through;    // at least two
  std::optional<Vec3> look_at;  // looks at this point instead
  bool is_eased = false;        // speeds up in the beginning and slows down in the end
};

// Particles that the camera keeps in view, wherever they are in the snapshots of a sequence: a
// halo, or what is innermost in a sphere. They are chosen in one snapshot and found in the others
// by their ids. The camera keeps its direction; positions and look-at points of the path are
// counted from their middle.
struct Follow {
  // What up is: as the camera and the path have it, or the angular momentum, with which everything
  // that is counted from the middle turns.
  enum class Up { camera, angular_momentum };

  std::optional<std::uint64_t> halo;    // of a catalog
  std::string catalog;                  // empty: the snapshot's field, else one beside it
  std::optional<Vec3> sphere_center;    // without halo; unset: the densest place
  std::optional<double> sphere_radius;  // > 0; unset: of a sphere 200 times as dense as the mean
  std::optional<double> snapshot;       // the index in which they are chosen; unset: the last drawn
  double size = 4;  // of the picture's shorter side, in radii of what is followed
  Up up = Up::camera;
};

// From what the scene's camera shows to a point, or to what is followed. The shown length changes
// by the same factor in equal times, and the camera turns to its end while much is in view.
struct Approach {
  std::optional<Vec3> to;       // unset: what is followed
  std::optional<double> width;  // across the picture in the end, > 0; unset: as Follow::size says
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
  std::optional<Follow> follow;
  std::optional<Approach> approach;
  std::vector<Keyframe> keyframes;  // in increasing order of their frames
  bool is_smooth = true;            // false: straight lines between keyframes
  Look look = Look::point;
  // In degrees per second: the view begins to turn earlier, and ends later, where it would turn
  // faster. > 0; unset: any.
  std::optional<double> max_turn_rate;
  // Leaves out keyframes that those that stay replace but for so much: of the distance to the
  // look-at point, of a radian, of all that a number changes. > 0; unset: all stay.
  std::optional<double> simplified_within;

  // Whether there is anything that changes.
  bool is_set() const {
    return !file.empty() || orbit || fly || follow || approach || !keyframes.empty();
  }
};

}  // namespace splotchcl
