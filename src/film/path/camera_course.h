#pragma once

#include <boost/qvm/quat.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "film/path/followed_way.h"
#include "film/path/view_line.h"
#include "film/path/zoom_curve.h"
#include "splotchcl/scene.h"

namespace splotchcl {

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
