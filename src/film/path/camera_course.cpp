#include "film/path/camera_course.h"

#include <algorithm>
#include <boost/qvm/quat_operations.hpp>
#include <boost/qvm/quat_vec_operations.hpp>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <cstddef>
#include <utility>

#include "film/path/camera_motion.h"
#include "scene_file/values.h"
#include "splotchcl/camera.h"

namespace splotchcl {
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
