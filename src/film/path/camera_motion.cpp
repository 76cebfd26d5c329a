#include "film/path/camera_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <cstddef>

#include "film/path/view_line.h"
#include "scene_file/values.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using boost::qvm::mag;

void check_orbit(const Orbit& orbit, const Camera& camera) {
  if (orbit.axis && !(mag(*orbit.axis) > 0)) {
    throw UsageError("path.orbit.axis: found [0, 0, 0], expected any direction");
  }
  const Vec3 center = orbit.center.value_or(camera.look_at);
  if (orbit.radius && !(mag(camera.position - center) > 0)) {
    throw UsageError(
        "path.orbit.radius: found a camera that stands at the center of its orbit, expected it "
        "elsewhere, in the direction in which the orbit begins");
  }
}

Flight make_flight(const FlyThrough& fly) {
  for (std::size_t i = 1; i < fly.through.size(); ++i) {
    if (mag(fly.through[i] - fly.through[i - 1]) > 0) continue;
    throw UsageError(
        fmt::format("path.fly.through: found point {} twice in a row, expected each point to "
                    "differ from the one before",
                    scene_file::vector().write(fly.through[i])));
  }
  return Flight(fly.through);
}

}  // namespace

double part_of_film(double frame, int frames) {
  return frames > 1 ? std::clamp(frame / (frames - 1), 0.0, 1.0) : 0;
}

double eased(double part) {
  return part * part * (3 - 2 * part);
}

CameraMotion::CameraMotion(const Scene& scene, int frames)
    : path_(scene.path), camera_(scene.camera.value_or(Camera())), frames_(frames) {
  if (path_.orbit) check_orbit(*path_.orbit, camera_);
  if (!path_.fly) return;
  flight_ = make_flight(*path_.fly);
  // The distance counts where the picture's scale or a pair of eyes depends on it.
  look_ahead_ = scene.camera ? mag(camera_.look_at - camera_.position) : flight_->length();
}

std::vector<std::string> CameraMotion::settings(double frame) const {
  if (path_.orbit) return on_orbit(frame);
  if (path_.fly) return on_flight(frame);
  return {};
}

std::vector<std::string> CameraMotion::on_orbit(double frame) const {
  const Orbit& orbit = *path_.orbit;
  const double degrees = orbit.degrees * part_of_turn(frame);
  const Vec3 center = orbit.center.value_or(camera_.look_at);
  const Vec3 axis = orbit.axis.value_or(camera_.sky);
  Vec3 start = camera_.position;
  if (orbit.radius) {
    const Vec3 arm = start - center;
    start = center + *orbit.radius / mag(arm) * arm;
  }
  std::vector<std::string> settings = {
      camera_setting("position", turned(start, center, axis, degrees))};
  // What lies on the axis stays, exactly.
  if (orbit.center)
    settings.push_back(camera_setting("look_at", turned(camera_.look_at, center, axis, degrees)));
  if (orbit.axis) {
    settings.push_back(camera_setting("sky", turned(camera_.sky, Vec3{{0, 0, 0}}, axis, degrees)));
  }
  return settings;
}

std::vector<std::string> CameraMotion::on_flight(double frame) const {
  const double t = part_of_film(frame, frames_);
  const Flight::State state = flight_->at(path_.fly->is_eased ? eased(t) : t);
  const Vec3 ahead = state.position + look_ahead_ * state.direction;
  return {camera_setting("position", state.position),
          camera_setting("look_at", path_.fly->look_at.value_or(ahead))};
}

// A whole turn without easing leaves out its last frame, which would be the first again.
double CameraMotion::part_of_turn(double frame) const {
  return path_.orbit->is_eased ? eased(part_of_film(frame, frames_)) : frame / frames_;
}

}  // namespace splotchcl
