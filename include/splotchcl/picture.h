#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "splotchcl/image.h"
#include "splotchcl/pixel_places.h"
#include "splotchcl/scene.h"
#include "splotchcl/views.h"

namespace splotchcl {

struct SnapshotInfo;
class Snapshot;

// What is made of a scene's light.
//   shown   what a display shows: with all that [finish] says
//   drawn   scene-linear light, as it has been drawn, for other programs to finish: views are put
//           together, fades and cross-fades mix it, and nothing else of [finish] is done
enum class PictureLight { shown, drawn, both };

// One picture that a scene asks for, ready to be written, in linear light.
struct Picture {
  std::string suffix;       // "" for the only one, else what tells its file from the others
  Image image;              // as shown; empty where that was not asked for
  Image light = {};         // as drawn, likewise
  PixelPlaces places = {};  // in the views that it shows
};

// One of those moments whose mean light a picture with motion blur has.
struct Moment {
  Scene scene;
  std::function<std::shared_ptr<const Snapshot>()> snapshot;  // opened when it is drawn
};

// Everything between a scene and the pictures that are written: loads the frame, draws its
// views, finishes each and puts them together. `notes` takes what the user should know.
// Throws as load_frame and `draw` do.
std::vector<Picture> draw_pictures(const Scene& scene, const Snapshot& snapshot,
                                   const DrawFrame& draw, std::vector<std::string>& notes);
// The same for a frame of the scene that is loaded already, with any crop.
std::vector<Picture> draw_pictures(const Scene& scene, const Frame& frame,
                                   const SnapshotInfo& snapshot, const DrawFrame& draw,
                                   std::vector<std::string>& notes);

// pair.png and "_left" are pair_left.png.
std::filesystem::path picture_path(const std::filesystem::path& output, const std::string& suffix);

}  // namespace splotchcl
