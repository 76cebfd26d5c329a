#pragma once

#include <functional>
#include <string>
#include <vector>

#include "splotchcl/frame.h"
#include "splotchcl/image.h"

namespace splotchcl {

struct Scene;

// Draws one frame: a Renderer's render, or the reference's.
using DrawFrame = std::function<Image(const Frame&)>;

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
  std::string suffix;         // as Picture has it
  int width = 0, height = 0;  // pixels
};
std::vector<PictureSize> picture_sizes(const Scene& scene, int view_width, int view_height);

}  // namespace splotchcl
