#pragma once

#include <optional>
#include <string>
#include <vector>

#include "film/path/path_table.h"
#include "splotchcl/scene.h"

namespace splotchcl {

// Whether the path itself says where the camera stands in every frame. Other paths need a
// scene with a camera. Reads the path's file.
bool path_has_camera(const Scene& scene);

// A scene's frames: its path file, orbit, fly-through and keyframes together, each frame as
// settings of the scene's keys.
class FilmPath {
 public:
  // Reads the path's file. The scene has a camera unless path_has_camera(). `notes` takes what
  // the user should know. Throws UsageError.
  FilmPath(const Scene& scene, std::vector<std::string>& notes);

  int frame_count() const { return static_cast<int>(settings_.size()); }
  // "key=value", as a frame sets the scene's keys.
  const std::vector<std::string>& settings(int frame) const;
  // The scene at a frame. Throws UsageError, naming the file, line and columns, or the frame.
  Scene scene_at(const Scene& scene, int frame) const;
  // Every frame; also that all pictures are of one size.
  void check(const Scene& scene) const;

 private:
  std::string where(int frame, const std::string& label) const;

  std::optional<PathTable> table_;
  std::vector<std::vector<std::string>> settings_;  // of each frame
};

}  // namespace splotchcl
