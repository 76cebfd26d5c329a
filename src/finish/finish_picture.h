#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "finish/bars.h"
#include "finish/overlay.h"
#include "splotchcl/frame.h"
#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"
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

// What can be told to be wrong with a scene's [finish] before particles are read: fonts,
// placeholders, names of components, the scene to fade to. Throws UsageError.
void check_finish(const Scene& scene, const SnapshotInfo& snapshot);

// The file of the font of a scene's texts and bars; none where there are none, or it is not there.
std::optional<std::filesystem::path> font_file(const FinishSettings& finish);

// What is done to one picture between its drawing and its file, up to the texts
// (splotchcl/finish.h). Everything is prepared, and refused if it cannot be, before the
// picture is drawn. Nothing is done for a scene that asks for nothing.
class PictureFinish {
 public:
  // The frame is that of the middle between the eyes where the picture is one eye's. Throws
  // UsageError.
  PictureFinish(const Scene& scene, const Frame& frame, const SnapshotInfo& snapshot,
                std::optional<Eye> eye = std::nullopt);

  // With this color bar in place of those of the scene's components.
  PictureFinish(const Scene& scene, const Frame& frame, const SnapshotInfo& snapshot,
                const ColorBarContent& color_bar);

  // `image` is the frame's, or the eye's, picture; `draw` draws the inset. `light` are the scene's
  // settings with an exposure and a white, which the pictures may have had to show first.
  void apply(Image& image, const FinishSettings& light, const DrawFrame& draw) const;

 private:
  void prepare(const Scene& scene, const Frame& frame, const SnapshotInfo& snapshot,
               const std::optional<ColorBarContent>& color_bar, Layout& layout);

  FinishSettings settings_;
  double gamma_;
  Rectangle crop_;
  std::optional<Inset> inset_;
  std::vector<Overlay> overlays_;
};

}  // namespace splotchcl
