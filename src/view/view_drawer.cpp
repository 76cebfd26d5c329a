#include "view/view_drawer.h"

#include <jpeglib.h>

#include <algorithm>
#include <chrono>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "image/picture_encoders.h"
#include "load/component_tree.h"
#include "scene/hash.h"
#include "scene/particle_columns.h"
#include "snapshot/derived_snapshots.h"
#include "snapshot/field_names.h"
#include "splotchcl/error.h"
#include "splotchcl/image_file.h"
#include "splotchcl/load.h"
#include "splotchcl/scene_file.h"

namespace splotchcl::view {
namespace {

// One of each of `count` equal runs, chosen at random from it.
Places choose(std::size_t all, std::size_t count) {
  constexpr std::uint64_t seed = 1;
  Places chosen(count);
  const double run = static_cast<double>(all) / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto first = static_cast<std::size_t>(static_cast<double>(i) * run);
    const auto end = std::min(all, static_cast<std::size_t>(static_cast<double>(i + 1) * run));
    const std::size_t length = std::max<std::size_t>(1, end - first);
    chosen[i] = std::min(all - 1, first + hash_of(hash_of(seed) + i) % length);
  }
  return chosen;
}

bool is_same(const Particles& known, const Particles& particles) {
  return known.origin == particles.origin && have_same_columns(known, particles);
}

}  // namespace

Frame FrameSampler::sample(const Frame& frame, std::uint64_t particles) {
  const std::uint64_t all = particle_count(frame);
  if (particles == 0 || all <= particles) return frame;
  ++frame_;
  Frame sampled = frame;
  const double share = static_cast<double>(particles) / static_cast<double>(all);
  for (std::size_t i = 0; i < sampled.components.size(); ++i) {
    DrawnComponent& component = sampled.components[i];
    const std::size_t count = component.particles.count;
    if (count == 0) continue;
    const auto some =
        std::max<std::size_t>(1, static_cast<std::size_t>(share * static_cast<double>(count)));
    component.particles = sample_component(i, frame.components[i].particles, some);
    const double stands_for = static_cast<double>(count) / static_cast<double>(some);
    component.reference_column /= stands_for;
    component.particles_per_drawn *= stands_for;
  }
  forget_unused();
  return sampled;
}

const Particles& FrameSampler::sample_component(std::size_t component, const Particles& all,
                                                std::size_t count) {
  Kept& kept = kept_[{component, count}];
  if (!is_same(kept.source, all)) kept = {all, picked_particles(all, choose(all.count, count)), 0};
  kept.last_frame = frame_;
  return kept.sample;
}

// Levels of previews come and go, pages take turns, and each sample keeps the columns alive that it
// was taken from.
void FrameSampler::forget_unused() {
  constexpr std::uint64_t frames = 8;
  for (auto kept = kept_.begin(); kept != kept_.end();)
    kept = kept->second.last_frame + frames < frame_ ? kept_.erase(kept) : std::next(kept);
}

namespace {

// jpeglib.h needs these two before it.
// clang-format off
// clang-format on
constexpr int quality = 85;

// The manager first: libjpeg hands out a pointer to it.
struct Errors {
  jpeg_error_mgr manager = {};
  jmp_buf failed = {};
  char text[JMSG_LENGTH_MAX] = {};
};

// libjpeg is written in C: no exception passes it, and it goes on after a failure by a jump.
[[noreturn]] void leave(j_common_ptr info) {
  auto* const errors = reinterpret_cast<Errors*>(info->err);
  (*info->err->format_message)(info, errors->text);
  longjmp(errors->failed, 1);
}

// Owns libjpeg's state and the memory that it makes.
class Compressor {
 public:
  Compressor() {
    info_.err = ::jpeg_std_error(&errors_.manager);
    errors_.manager.error_exit = leave;
  }
  ~Compressor() {
    ::jpeg_destroy_compress(&info_);
    std::free(bytes_);
  }
  Compressor(const Compressor&) = delete;
  Compressor& operator=(const Compressor&) = delete;

  // Nothing with a destructor is made here: a jump would pass it by. False: it failed.
  bool compress(int width, int height, const std::uint8_t* rgb) {
    if (setjmp(errors_.failed) != 0) return false;
    ::jpeg_create_compress(&info_);
    ::jpeg_mem_dest(&info_, &bytes_, &size_);
    info_.image_width = static_cast<JDIMENSION>(width);
    info_.image_height = static_cast<JDIMENSION>(height);
    info_.input_components = 3;
    info_.in_color_space = JCS_RGB;
    ::jpeg_set_defaults(&info_);
    ::jpeg_set_quality(&info_, quality, TRUE);
    ::jpeg_start_compress(&info_, TRUE);
    while (info_.next_scanline < info_.image_height) {
      // libjpeg asks for pointers to what it only reads.
      auto* row = const_cast<JSAMPLE*>(rgb + std::size_t{3} * info_.next_scanline *
                                                 static_cast<std::size_t>(width));
      ::jpeg_write_scanlines(&info_, &row, 1);
    }
    ::jpeg_finish_compress(&info_);
    return true;
  }

  std::string problem() const { return errors_.text; }
  std::vector<unsigned char> bytes() const { return {bytes_, bytes_ + size_}; }

 private:
  Errors errors_;
  jpeg_compress_struct info_ = {};
  unsigned char* bytes_ = nullptr;
  unsigned long size_ = 0;
};

// A JPEG file of red, green and blue of each pixel, rows from the top: previews, where time counts
// more than the last digit. Throws DataError.
std::vector<unsigned char> encode_jpeg(int width, int height,
                                       const std::vector<std::uint8_t>& rgb) {
  Compressor compressor;
  if (!compressor.compress(width, height, rgb.data()))
    throw DataError("a preview cannot be stored as JPEG: " + compressor.problem());
  return compressor.bytes();
}

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
  const Picture& shown = drawn.pictures.front();
  const Image& image = shown.image;
  ImageFileOptions options = image_file_options(scene);
  options.places = shown.places;
  const std::vector<std::uint8_t> rgb = display_bytes("picture", image, options);
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
  tree_maker_.emplace(opened_, snapshot_);
}

std::shared_ptr<const Snapshot> ViewDrawer::snapshot_of(const Scene& scene) const {
  if (!scene.time.is_set()) return snapshot_;
  moment_ = source_.at(scene);
  return moment_;
}

const Component& ViewDrawer::component_for(const std::string& type) {
  if (const auto known = components_for_.find(type); known != components_for_.end())
    return known->second;
  const std::optional<int> number = find_particle_type(type);
  if (!number || snapshot_->info().find_type(*number) == nullptr) {
    throw UsageError("a component: found particles of the type '" + type +
                     "', expected some that the snapshot has");
  }
  Scene alone = opened_;
  alone.path = {};
  alone.components = {suggest_component(*snapshot_, {*number})};
  alone.components.front().name = type;
  return components_for_[type] = decide(alone).components.front();
}

Scene ViewDrawer::with_look(const std::string& look) const {
  const std::optional<Look> known = apply_settings(Scene(), {"look=" + look}).look;
  Scene suggested = suggest_scene(*snapshot_, known.value_or(Look::press));
  suggested.snapshot = opened_.snapshot;
  suggested.read = opened_.read;
  return decide(suggested);
}

Scene ViewDrawer::decide(const Scene& scene) const {
  if (is_decided(scene)) return scene;
  std::vector<std::string> ignored;
  return fixed_scene(splotchcl::decide(scene, *snapshot_of(scene), ignored));
}

Frame ViewDrawer::load(const Scene& scene) const {
  std::vector<std::string> ignored;
  const Trees* const trees = tree_maker_ ? tree_maker_->trees() : nullptr;
  if (trees != nullptr) give_trees(*snapshot_, *trees);
  return load_frame(scene, *snapshot_of(scene), ignored);
}

Frame ViewDrawer::sample(const Scene& scene, std::uint64_t particles) {
  const Frame frame = load(scene);
  if (particles > 0 && particle_count(frame) > particles) {
    if (std::optional<Frame> nodes = tree_preview_.of(frame, particles)) return std::move(*nodes);
  }
  return sampler_.sample(frame, particles);
}

ViewPicture ViewDrawer::preview(const Scene& scene, const PreviewLevel& level) {
  const Seconds seconds;
  Scene smaller = scene;
  smaller.image.width = std::max(1, scene.image.width / level.divisor);
  smaller.image.height = std::max(1, scene.image.height / level.divisor);
  smaller.tolerance = std::max(scene.tolerance, preview_tolerance);
  const Frame frame = sample(smaller, level.particles);
  drawer_.keep(PictureLight::shown);
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

DrawnFrame ViewDrawer::draw(const Scene& scene, PictureLight light) {
  drawer_.keep(light);
  return drawer_.draw(scene, load(scene), snapshot_of(scene)->info());
}

}  // namespace splotchcl::view
