#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "splotchcl/frame.h"
#include "splotchcl/image.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// Draws one frame: a Renderer's render, or the reference's.
using DrawFrame = std::function<Image(const Frame&)>;

// One picture that a scene asks for, ready to be written, in linear light.
struct Picture {
  std::string suffix;  // "" for the only one, else what tells its file from the others
  Image image;
};

// One drawing of a frame on the way to a picture. The frame shares its particles.
struct FrameView {
  std::string suffix;  // of the picture that it is, or is a part of
  Frame frame;
};

// The frames that a scene's pictures are drawn from: one, or one for each eye and face.
std::vector<FrameView> views_of(const Scene& scene, const Frame& frame);

// What a scene's pictures look like before any of them is drawn. With a crop, give its size
// for the width and height of the view.
// Two eyes and six faces may be one picture each or parts of one.
struct PictureSize {
  std::string suffix;
  int width = 0, height = 0;
};
std::vector<PictureSize> picture_sizes(const Scene& scene, int view_width, int view_height);

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
