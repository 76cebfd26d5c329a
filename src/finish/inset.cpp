#include "finish/inset.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>

#include "common/words.h"
#include "finish/tone.h"
#include "image/background_image.h"
#include "scene/constants.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr double degrees = 180 / pi;

// The inset's camera: the picture's own, as its frame has it, where nothing else is said.
Camera camera_of(const InsetSettings& settings, const Frame& frame) {
  const CameraFrame& own = frame.camera;
  Camera camera;
  camera.projection = frame.projection;
  camera.near_limit = frame.near_limit;
  camera.far_limit = frame.far_limit;
  camera.position = settings.position.value_or(own.position);
  camera.look_at =
      settings.look_at.value_or(Vec3(own.position + own.forward * own.look_at_distance));
  camera.sky = settings.sky.value_or(boost::qvm::cross(own.right, own.forward));
  camera.field_of_view_degrees = settings.field_of_view_degrees;
  if (is_wide_angle(frame.projection)) {
    camera.projection = Projection::perspective;
  } else if (!camera.field_of_view_degrees) {
    camera.field_of_view_degrees = 2 * degrees * std::atan(0.5 * frame.width / own.focal_pixels);
  }
  return camera;
}

void keep_components(const std::vector<std::string>& names, std::vector<DrawnComponent>& all) {
  if (names.empty()) return;
  const auto is_hidden = [&names](const DrawnComponent& component) {
    return std::find(names.begin(), names.end(), component.name) == names.end();
  };
  all.erase(std::remove_if(all.begin(), all.end(), is_hidden), all.end());
}

// With two eyes, those of the inset are as far apart as suits its own look-at point.
CameraFrame inset_camera(const Scene& scene, const Frame& frame, std::optional<Eye> eye, int width,
                         int height) {
  try {
    const Camera camera = camera_of(scene.finish.inset, frame);
    CameraFrame seen = make_camera_frame(camera, width, height);
    if (scene.image.convention == PixelConvention::original) seen = in_original_convention(seen);
    return eye ? eye_camera(seen, camera.projection, *scene.stereo, *eye) : seen;
  } catch (const UsageError& error) {
    throw UsageError(std::string("finish.inset: ") + error.what());
  }
}

}  // namespace

void check_inset(const Scene& scene) {
  std::vector<std::string> known;
  for (const Component& component : scene.components)
    known.push_back(component.name);
  for (const std::string& name : scene.finish.inset.components) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw UsageError(fmt::format(
        "key finish.inset.components: found \"{}\", expected names of components, which are "
        "\"{}\"{}",
        name, fmt::join(known, "\", \""), did_you_mean(nearest_name(name, known))));
  }
}

Inset make_inset(const Scene& scene, const Frame& frame, std::optional<Eye> eye, Layout& layout) {
  const InsetSettings& settings = scene.finish.inset;
  const int width = std::max(1, static_cast<int>(std::lround(settings.size[0] * frame.width)));
  const int height = std::max(1, static_cast<int>(std::lround(settings.size[1] * frame.height)));
  const double border = std::ceil(settings.border * layout.unit());
  const Box box =
      layout.place(settings.at, width + 2 * border, height + 2 * border, "finish.inset");

  Inset inset;
  inset.border = box;
  inset.border_light = light_of(settings.border_color, scene.image.gamma);
  inset.x = static_cast<int>(box.left + border);
  inset.y = static_cast<int>(box.top + border);
  inset.frame = frame;
  inset.frame.width = width;
  inset.frame.height = height;
  inset.frame.crop = {0, 0, width, height};
  inset.frame.camera = inset_camera(scene, frame, eye, width, height);
  if (is_wide_angle(frame.projection)) inset.frame.projection = Projection::perspective;
  if (frame.background_image) {
    inset.frame.background_image =
        std::make_shared<const Image>(scaled_to_fill(*frame.background_image, width, height));
  }
  keep_components(settings.components, inset.frame.components);
  return inset;
}

void put(Canvas& canvas, const Inset& inset, const Image& picture) {
  canvas.fill(inset.border, inset.border_light);
  canvas.paste(picture, inset.x, inset.y);
}

}  // namespace splotchcl
