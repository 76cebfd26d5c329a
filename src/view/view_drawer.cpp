#include "view/view_drawer.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <utility>

#include "image/png_file.h"
#include "snapshot/cached_snapshot.h"
#include "splotchcl/image_file.h"
#include "splotchcl/load.h"
#include "view/jpeg.h"

namespace splotchcl::view {
namespace {

// Of previews: a hundredth of white is not seen while the picture moves.
constexpr double preview_tolerance = 0.01;

class Seconds {
 public:
  double passed() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

FrameDrawerOptions drawer_options(const ViewDrawer::Options& options) {
  FrameDrawerOptions result;
  result.device = options.device;
  result.shape = options.shape;
  result.progress = [go_on = options.go_on](const std::string&, double) {
    if (go_on && !go_on()) throw DrawingCancelled();
  };
  return result;
}

// The first picture, of scenes that have several.
ViewPicture stored(const Scene& scene, const DrawnFrame& drawn, bool as_jpeg) {
  const Image& image = drawn.pictures.front().image;
  const std::vector<std::uint8_t> rgb = display_bytes("picture", image, image_file_options(scene));
  ViewPicture picture;
  picture.is_jpeg = as_jpeg;
  picture.file = as_jpeg ? encode_jpeg(image.width, image.height, rgb)
                         : encode_png("picture", image.width, image.height, rgb);
  picture.finish = drawn.finish;
  picture.notes = drawn.all_notes();
  return picture;
}

}  // namespace

ViewDrawer::ViewDrawer(SceneWithSnapshot source, const Options& options,
                       std::vector<std::string>& notes)
    : suggested_(std::move(source.suggested)),
      snapshot_(std::make_shared<CachedSnapshot>(std::move(source.snapshot))),
      drawer_(drawer_options(options)) {
  opened_ = fixed_scene(splotchcl::decide(source.scene, *snapshot_, notes));
  particles_ = particle_count(load(opened_));
}

std::shared_ptr<const Snapshot> ViewDrawer::snapshot_of(const Scene& scene) const {
  if (!scene.time.is_set()) return snapshot_;
  moment_ = source_.at(scene);
  return moment_;
}

Scene ViewDrawer::decide(const Scene& scene) const {
  if (is_decided(scene)) return scene;
  std::vector<std::string> ignored;
  return fixed_scene(splotchcl::decide(scene, *snapshot_of(scene), ignored));
}

Frame ViewDrawer::load(const Scene& scene) const {
  std::vector<std::string> ignored;
  return load_frame(scene, *snapshot_of(scene), ignored);
}

Frame ViewDrawer::sample(const Scene& scene, std::uint64_t particles) {
  return sampler_.sample(load(scene), particles);
}

ViewPicture ViewDrawer::preview(const Scene& scene, const PreviewLevel& level) {
  const Seconds seconds;
  Scene smaller = scene;
  smaller.image.width = std::max(1, scene.image.width / level.divisor);
  smaller.image.height = std::max(1, scene.image.height / level.divisor);
  smaller.tolerance = std::max(scene.tolerance, preview_tolerance);
  const Frame frame = sample(smaller, level.particles);
  const DrawnFrame drawn = drawer_.draw(smaller, frame, snapshot_of(smaller)->info());
  ViewPicture picture = stored(smaller, drawn, true);
  picture.seconds = seconds.passed();
  return picture;
}

ViewPicture ViewDrawer::exact(const Scene& scene) {
  const Seconds seconds;
  ViewPicture picture = stored(scene, draw(scene), false);
  picture.seconds = seconds.passed();
  return picture;
}

DrawnFrame ViewDrawer::draw(const Scene& scene) {
  return drawer_.draw(scene, load(scene), snapshot_of(scene)->info());
}

}  // namespace splotchcl::view
