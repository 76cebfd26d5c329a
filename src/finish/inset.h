#pragma once

#include <optional>

#include "finish/overlay.h"
#include "splotchcl/frame.h"
#include "splotchcl/scene.h"
#include "splotchcl/stereo.h"
#include "splotchcl/views.h"

namespace splotchcl {

// The second view, before it is drawn.
struct Inset {
  Frame frame;
  int x = 0, y = 0;  // of its corner, without the border
  Box border;
  Light border_light{};
};

// Throws UsageError for names that no component has.
void check_inset(const Scene& scene);

// The frame as the inset's camera, or an eye of it, sees it, and its place. The frame has the
// camera in the middle between or beside the eyes. Throws UsageError where the inset's camera
// or its size is not possible.
Inset make_inset(const Scene& scene, const Frame& frame, std::optional<Eye> eye, Layout& layout);

// `picture` is the inset's own, with the picture's exposure, saturation and contrast.
void put(Canvas& canvas, const Inset& inset, const Image& picture);

}  // namespace splotchcl
