#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sequence/film_snapshots.h"
#include "splotchcl/picture.h"
#include "splotchcl/scene.h"

namespace splotchcl {

// The scenes that a film's frames fade to, by their files. Their data is read once.
class OtherScenes {
 public:
  // Decides, as this frame shows it, what the scene that it fades to leaves to the data; frames
  // drawn later take that. Nothing where there is none, or it is decided.
  void decide(const Scene& scene);

  // The other scene's pictures. `other` is cross_fade_scene() of a frame.
  std::vector<Picture> draw(const std::string& file, Scene other, const Rectangle& crop,
                            const DrawFrame& draw, std::vector<std::string>& notes);

 private:
  struct OtherScene {
    FilmSnapshots snapshots;
    std::optional<Scene> decided;
  };
  std::map<std::string, OtherScene> by_file_;
};

// draw_pictures() for the frames of a film.
std::vector<Picture> draw_pictures(const Scene& scene, const Frame& frame,
                                   const SnapshotInfo& snapshot, const DrawFrame& draw,
                                   std::vector<std::string>& notes, OtherScenes& other_scenes);

}  // namespace splotchcl
