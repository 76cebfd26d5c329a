#pragma once

#include <optional>
#include <string>
#include <vector>

#include "splotchcl/camera.h"
#include "splotchcl/vector.h"

namespace splotchcl {

// "camera.KEY=[x, y, z]"
std::string camera_setting(const std::string& key, const Vec3& value);

// The value of the last of these settings that is of the camera's KEY.
std::optional<Vec3> camera_value(const std::vector<std::string>& settings, const std::string& key);

// Where a camera stands, and how it looks.
struct ViewLine {
  Vec3 position = {{0, 0, 0}}, look_at = {{0, 0, 1}}, sky = {{0, 1, 0}};

  explicit ViewLine(const Camera& camera)
      : position(camera.position), look_at(camera.look_at), sky(camera.sky) {}
  // With what the settings say instead.
  ViewLine(const Camera& camera, const std::vector<std::string>& settings);

  // In place of what the settings say of them.
  void put_into(std::vector<std::string>& settings) const;
};

// Directions of length 1 that never turn by more than `most_radians` from one to the next: each is
// the mean of those around it, of as few as it takes, so that turns begin earlier and end later.
// Empty where half of all would not do: what turns all along cannot turn more slowly.
std::vector<Vec3> with_slow_turns(const std::vector<Vec3>& directions, double most_radians);

// The largest turn from one direction to the next, in radians.
double largest_turn(const std::vector<Vec3>& directions);

// Between two directions of length 1, in radians.
double angle_between(const Vec3& a, const Vec3& b);

}  // namespace splotchcl
