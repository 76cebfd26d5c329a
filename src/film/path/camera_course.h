#pragma once

#include <boost/qvm/quat.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "film/path/followed_way.h"
#include "film/path/view_line.h"
#include "scene/curves.h"
#include "splotchcl/camera.h"
#include "splotchcl/path.h"
#include "splotchcl/scene.h"

namespace splotchcl {

// How far a film is, 0 at its first and 1 at its last frame.
double part_of_film(double frame, int frames);

// From 0 to 1 as the argument goes, slowly at both ends.
double eased(double part);

// The camera on an orbit or a flight, or standing still.
class CameraMotion {
 public:
  // An orbit needs a scene with a camera. Throws UsageError.
  CameraMotion(const Scene& scene, int frames);

  // "key=value" for what moves.
  std::vector<std::string> settings(double frame) const;

 private:
  std::vector<std::string> on_orbit(double frame) const;
  std::vector<std::string> on_flight(double frame) const;
  double part_of_turn(double frame) const;

  PathSettings path_;
  Camera camera_;
  int frames_;
  std::optional<Flight> flight_;
  double look_ahead_ = 0;
};

// The way from one view to another that moves and scales at once, so that what is seen changes as
// evenly and as little as it can (van Wijk & Nuij, IEEE InfoVis 2003): it moves while much is in
// view. Where nothing is to be moved, the shown length changes by the same factor in equal times.
class ZoomCurve {
 public:
  struct View {
    double part = 0;   // of the way that the view's middle has gone, 0 to 1
    double width = 0;  // the shown length
  };

  // Widths above 0; the distance between the two views' middles.
  ZoomCurve(double first_width, double last_width, double distance);

  // At this part of the whole curve, from 0 to 1.
  View at(double fraction) const;

 private:
  double first_width_, last_width_, distance_;
  double first_ = 0, length_ = 0;  // of the curve
};

// What following and approaching make of the camera that the rest of the path moves.
class CameraCourse {
 public:
  // The index of the sequence at a frame, or between two.
  using IndexAt = std::function<double(double frame)>;

  // With what is followed, where the scene says so. The scene has a camera unless its path has
  // neither. Throws UsageError.
  CameraCourse(const Scene& scene, int frames, std::optional<FollowedWay> way, IndexAt index_at);

  // The scene with the camera from which the rest of the path begins: counted from what is
  // followed, and as far away that it has the wanted size.
  const Scene& start() const { return start_; }
  // Moves the camera of a frame's settings.
  void apply(double frame, std::vector<std::string>& settings) const;

 private:
  using Turn = boost::qvm::quat<double>;

  void begin_to_follow();
  void begin_to_approach(const Scene& scene);
  Turn turn_at(double frame) const;
  ViewLine followed(ViewLine line, double frame) const;
  ViewLine approached(ViewLine line, double frame) const;

  Scene start_;
  int frames_;
  std::optional<FollowedWay> way_;
  IndexAt index_at_;
  std::vector<Turn> turns_;              // at each frame; none: nothing turns
  std::optional<double> field_of_view_;  // in place of a width, which would stay the same
  // Of an approach.
  std::optional<ZoomCurve> curve_;
  Vec3 first_look_at_ = {{0, 0, 0}};
  double distance_per_width_ = 1;
};

}  // namespace splotchcl
