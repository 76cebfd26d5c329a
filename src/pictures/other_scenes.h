#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pictures/units_of_white.h"
#include "sequence/snapshot_source.h"
#include "splotchcl/picture.h"
#include "splotchcl/scene.h"

namespace splotchcl {

// The scenes that a film's frames fade to, by their files. Their data is read once.
class OtherScenes {
 public:
  // Decides, as this frame shows it, what the scene that it fades to leaves to the data; frames
  // drawn later take that. Nothing where there is none, or it is decided.
  void decide(const Scene& scene);

  // Whether this frame fades to a scene that leaves its exposure or white to pictures, of which
  // none has been drawn.
  bool lacks_tone(const Scene& scene) const;

  // The other scene's pictures. `other` is cross_fade_scene() of a frame, `moments` are those of
  // the frame.
  std::vector<Picture> draw(const std::string& file, Scene other, const Rectangle& crop,
                            const DrawFrame& draw, PictureLight light,
                            const KeepsPromise& keeps_promise, std::vector<std::string>& notes,
                            const std::vector<Moment>& moments = {});

 private:
  struct OtherScene {
    FilmSnapshots snapshots;
    std::optional<Scene> decided;
    std::optional<FinishSettings> tone;  // as the first picture with light showed it
  };
  std::map<std::string, OtherScene> by_file_;
};

// A scene's pictures, and what they decided.
struct DrawnPictures {
  std::vector<Picture> pictures;
  // The scene's, with the exposure and the white that were found where the scene leaves them to
  // the picture. Still open where nothing of the scene itself was drawn.
  FinishSettings finish;
  bool is_black = false;  // nothing could be found, for lack of light
};

// draw_pictures() for the frames of a film: of the moments, where there are some, the mean light.
DrawnPictures draw_pictures(const Scene& scene, const Frame& frame, const SnapshotInfo& snapshot,
                            const DrawFrame& draw, std::vector<std::string>& notes,
                            OtherScenes& other_scenes, PictureLight light = PictureLight::shown,
                            const KeepsPromise& keeps_promise = {},
                            const std::vector<Moment>& moments = {},
                            const LooseDrawing& loose = {});

}  // namespace splotchcl
