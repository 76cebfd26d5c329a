#include "film/path/camera_course.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/qvm/quat_operations.hpp>
#include <boost/qvm/quat_vec_operations.hpp>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <cstddef>
#include <utility>

#include "film/path/view_line.h"
#include "scene_file/values.h"
#include "splotchcl/camera.h"
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

namespace {

// How much moving counts beside scaling: rho^2 of the paper.
constexpr double weight = 2;
const double root = std::sqrt(weight);

}  // namespace

ZoomCurve::ZoomCurve(double first_width, double last_width, double distance)
    : first_width_(first_width), last_width_(last_width), distance_(distance) {
  constexpr double hardly = 1e-9;
  if (distance_ <= hardly * first_width_) {
    distance_ = 0;
    return;
  }
  const double widths = last_width * last_width - first_width * first_width;
  const double moved = weight * weight * distance * distance;
  const auto place = [&](double width, double sum) {
    return std::asinh(-sum / (2 * width * weight * distance));
  };
  first_ = place(first_width, widths + moved);
  length_ = (place(last_width, widths - moved) - first_) / root;
}

ZoomCurve::View ZoomCurve::at(double fraction) const {
  if (fraction >= 1) return {1, last_width_};
  if (distance_ == 0) {
    return {fraction, first_width_ * std::pow(last_width_ / first_width_, fraction)};
  }
  const double place = root * fraction * length_ + first_;
  // sinh(place - first) / cosh(place) is cosh(first) tanh(place) - sinh(first), without its
  // cancellation.
  const double moved = first_width_ / weight * std::sinh(place - first_) / std::cosh(place);
  return {moved / distance_, first_width_ * std::cosh(first_) / std::cosh(place)};
}

namespace {

using namespace boost::qvm;

// The smallest rotation from one direction of length 1 to another.
quat<double> smallest_turn(const Vec3& from, const Vec3& to) {
  const Vec3 axis = cross(from, to);
  const double sine = mag(axis), cosine = dot(from, to);
  constexpr double hardly = 1e-12;
  if (sine > hardly) return rot_quat(Vec3(axis / sine), std::atan2(sine, cosine));
  if (cosine > 0) return identity_quat<double>();
  const Vec3 other = std::abs(from.a[0]) < 0.5 ? Vec3{{1, 0, 0}} : Vec3{{0, 1, 0}};
  constexpr double half_turn = 3.14159265358979323846;
  return rot_quat(normalized(cross(from, other)), half_turn);
}

// The length across the picture at the look-at point, and that over the camera's distance from it.
struct Scale {
  double width, per_distance, shorter_side;
};
Scale scale_of(const Camera& camera, const ImageSettings& image) {
  const CameraFrame frame = make_camera_frame(camera, image.width, image.height);
  const double length_of_pixel = 1 / frame.pixels_per_length;
  return {image.width * length_of_pixel, image.width * length_of_pixel / frame.look_at_distance,
          std::min(image.width, image.height) * length_of_pixel};
}

}  // namespace

CameraCourse::CameraCourse(const Scene& scene, int frames, std::optional<FollowedWay> way,
                           IndexAt index_at)
    : start_(scene), frames_(frames), way_(std::move(way)), index_at_(std::move(index_at)) {
  if (!way_ && !scene.path.approach) return;
  Camera& camera = *start_.camera;
  if (camera.width) {
    field_of_view_ = field_of_view_degrees(camera);
    camera.field_of_view_degrees = field_of_view_;
    camera.width.reset();
  }
  const Scene as_given = start_;
  if (way_) begin_to_follow();
  if (scene.path.approach) begin_to_approach(as_given);
}

void CameraCourse::begin_to_follow() {
  Camera& camera = *start_.camera;
  const Vec3 towards_camera = camera.position - camera.look_at;
  const double shown = scale_of(camera, start_.image).shorter_side;
  const double wanted = start_.path.follow->size * way_->radius();
  camera.look_at = Vec3{{0, 0, 0}};
  camera.position = wanted / shown * towards_camera;
  if (start_.path.follow->up == Follow::Up::camera) return;
  Vec3 up = normalized(camera.sky);
  Turn turn = identity_quat<double>();
  for (int frame = 0; frame < frames_; ++frame) {
    const Vec3 next = way_->up(index_at_(frame));
    turn = smallest_turn(up, next) * turn;
    turns_.push_back(turn);
    up = next;
  }
}

// Ends where what is followed is with the last frame.
void CameraCourse::begin_to_approach(const Scene& scene) {
  const Approach& approach = *scene.path.approach;
  const Scale first = scale_of(*scene.camera, scene.image);
  const double last_width =
      approach.width ? *approach.width : scale_of(*start_.camera, start_.image).width;
  first_look_at_ = scene.camera->look_at;
  const Vec3 end = approach.to ? *approach.to : way_->center(index_at_(frames_ - 1));
  curve_.emplace(first.width, last_width, mag(end - first_look_at_));
  distance_per_width_ = 1 / first.per_distance;
}

CameraCourse::Turn CameraCourse::turn_at(double frame) const {
  const int before = std::clamp(static_cast<int>(std::floor(frame)), 0, frames_ - 1);
  const Vec3 from = way_->up(index_at_(before)), to = way_->up(index_at_(frame));
  return smallest_turn(from, to) * turns_[static_cast<std::size_t>(before)];
}

ViewLine CameraCourse::followed(ViewLine line, double frame) const {
  if (!turns_.empty()) {
    const Turn turn = turn_at(frame);
    line.position = turn * line.position;
    line.look_at = turn * line.look_at;
    line.sky = turn * line.sky;
  }
  const Vec3 center = way_->center(index_at_(frame));
  line.position += center;
  line.look_at += center;
  return line;
}

ViewLine CameraCourse::approached(ViewLine line, double frame) const {
  const Vec3 towards_camera = normalized(line.position - line.look_at);
  const Vec3 target = start_.path.approach->to.value_or(line.look_at);
  const ZoomCurve::View view = curve_->at(eased(part_of_film(frame, frames_)));
  line.look_at = first_look_at_ + view.part * (target - first_look_at_);
  line.position = line.look_at + view.width * distance_per_width_ * towards_camera;
  return line;
}

void CameraCourse::apply(double frame, std::vector<std::string>& settings) const {
  if (!way_ && !curve_) return;
  ViewLine line(*start_.camera, settings);
  if (way_) line = followed(line, frame);
  if (curve_) line = approached(line, frame);
  line.put_into(settings);
  if (field_of_view_) {
    settings.insert(settings.begin(),
                    "camera.field_of_view=" + scene_file::write_number(*field_of_view_));
  }
}

}  // namespace splotchcl
