#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "film/path/followed_way.h"
#include "film/path/path_table.h"
#include "splotchcl/scene.h"

namespace splotchcl {

// Whether the path itself says where the camera stands in every frame. Other paths need a
// scene with a camera. Reads the path's file.
bool path_has_camera(const Scene& scene);

// A scene's frames: its path file, orbit, fly-through and keyframes together, what is followed and
// approached, each frame as settings of the scene's keys.
class FilmPath {
 public:
  // Reads the path's file. The scene has a camera unless path_has_camera(). `notes` takes what
  // the user should know. `find` is needed for a path that follows something. Throws UsageError.
  FilmPath(const Scene& scene, std::vector<std::string>& notes, const FindFollowed& find = {});

  int frame_count() const { return static_cast<int>(settings_.size()); }
  // "key=value", as a frame sets the scene's keys.
  const std::vector<std::string>& settings(int frame) const;
  // The scene at a frame. Throws UsageError, naming the file, line and columns, or the frame.
  Scene scene_at(const Scene& scene, int frame) const;
  // The scenes whose mean the frame is; none without motion blur.
  std::vector<Scene> blurred_scenes(const Scene& scene, int frame) const;
  // Every frame; also that all pictures are of one size.
  void check(const Scene& scene) const;

 private:
  std::string where(int frame, const std::string& label) const;
  Scene scene_of(const Scene& scene, int frame, const std::vector<std::string>& settings) const;

  std::optional<PathTable> table_;
  std::vector<std::vector<std::string>> settings_;  // of each frame
  // Of each frame with motion blur, one after the other, of the first frame first.
  std::vector<std::vector<std::string>> blurred_;
  std::size_t samples_ = 0;
};

// The scene's keyframes, such as those of a recorded flight, without those that the others replace
// within path.simplify: at the frame of each the film comes as close to what it said. Those that
// are eased or dwell stay. The scene itself where it does not ask for that. `notes` takes how many
// are left. Throws UsageError as KeyframeTracks.
Scene with_simple_path(Scene scene, std::vector<std::string>& notes);

}  // namespace splotchcl
