#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "film/path/camera_course.h"
#include "film/path/camera_motion.h"
#include "film/path/followed_way.h"
#include "film/path/keyframe_tracks.h"
#include "film/path/path_table.h"
#include "splotchcl/scene.h"

namespace splotchcl {

// What the parts of a path together set at its frames, and between them.
class FrameSettings {
 public:
  // `table` may be null. `find` is asked for what is followed, if anything is. `notes` takes what
  // the user should know. Throws UsageError.
  FrameSettings(const Scene& scene, const PathTable* table, int frames, const FindFollowed& find,
                std::vector<std::string>& notes);

  FrameSettings(const FrameSettings&) = delete;
  FrameSettings& operator=(const FrameSettings&) = delete;

  // "key=value". Without a table also between frames.
  std::vector<std::string> at(double frame) const;

 private:
  std::vector<std::string> without_course(double frame) const;
  double index_at(double frame) const;
  std::optional<FollowedWay> find_way(const Scene& scene, const FindFollowed& find) const;
  void limit_turns(const Scene& scene, std::vector<std::string>& notes);
  void turn_slowly(double frame, std::vector<std::string>& settings) const;

  const PathTable* table_;
  int frames_;
  double scene_index_;
  Camera camera_;  // where nothing moves it
  KeyframeTracks keyframes_;
  std::optional<CameraCourse> course_;
  std::optional<CameraMotion> motion_;
  std::vector<Vec3> views_;  // of each frame, where the path's own turn too fast
};

}  // namespace splotchcl
