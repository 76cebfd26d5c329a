#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands.h"
#include "cli/draw_options.h"
#include "cli/processes.h"
#include "common/output_files.h"
#include "common/unfinished_file.h"
#include "finish/overlay.h"
#include "finish/ticks.h"
#include "open_scene/input_files.h"
#include "publish/light_splats.h"
#include "publish/viewer_splats.h"
#include "publish/web_page.h"
#include "splotchcl/error.h"
#include "splotchcl/frame_drawer.h"
#include "splotchcl/load.h"
#include "splotchcl/open_scene.h"
#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"

namespace splotchcl::cli {
namespace {

constexpr int longest_side = 512;
constexpr double steps = 255;

Frame over_black(Frame frame) {
  frame.background = {0, 0, 0};
  frame.background_image = nullptr;
  return frame;
}

// The scene with a picture no larger than what files of splats are compared by.
Scene as_compared(Scene scene) {
  const double part =
      static_cast<double>(longest_side) / std::max(scene.image.width, scene.image.height);
  if (part < 1) {
    for (int* const side : {&scene.image.width, &scene.image.height})
      *side = std::max(1, static_cast<int>(std::lround(part * *side)));
  }
  scene.finish.bloom = 0;
  return scene;
}

// Writes a file of splats for other viewers (publish/viewer_splats.h), and says how far these show
// it from the frame, which is the scene's as it is compared.
void publish_splats(const std::filesystem::path& path, const Scene& scene, const Frame& frame,
                    const SnapshotInfo& snapshot, const std::vector<LightSplat>& splats,
                    std::size_t particles, FrameDrawer& drawer, Console& console) {
  console.status("drawing what the splats are to show");
  DrawnFrame drawn = drawer.draw(scene, over_black(frame), snapshot);
  const DisplayLight display = {drawn.finish.value_or(scene.finish), scene.image.gamma};
  console.status("looking for the nearest opacities");
  const NearestSplats nearest =
      nearest_splats(splats, frame, drawn.pictures.front().light, display);
  const std::string about = fmt::format(
      "{} splats for {} particles; viewers show them {:.1f} of 255 steps (rms) from the picture, "
      "{:.0f} at most",
      splats.size(), particles, steps * nearest.rms_difference, steps * nearest.largest_difference);
  const std::string text = as_splat_file(path, nearest.splats, frame, about);
  UnfinishedFile file(path);
  file.write(text.data(), text.size());
  file.finish();
  console.done(fmt::format("{}: {:.1f} MB, {}", path.string(),
                           1e-6 * static_cast<double>(text.size()), about));
}

constexpr std::uint64_t most_page_bytes = 20'000'000;
// Viewers leave out dim splats.
constexpr std::size_t splats_of_pages = 400'000, splats_for_viewers = 100'000;

// A folder gets a page of the name that servers look for.
std::filesystem::path page_path(const std::filesystem::path& output) {
  const bool is_folder = output.filename().empty() || std::filesystem::is_directory(output);
  return is_folder ? output / "index.html" : output;
}

void check_page_path(const std::filesystem::path& path) {
  if (path.extension() != ".html" && !is_splat_file(path)) {
    throw UsageError(fmt::format(
        "--output: found {}, expected a folder, or a name that ends in .html, .ply, .glb or .usda",
        path.string()));
  }
  if (path.has_parent_path() && path.filename() == "index.html") {
    std::error_code failed;
    std::filesystem::create_directory(path.parent_path(), failed);
  }
  check_output_path(path);
}

// What a scene says of its pictures that nothing published shows.
std::vector<std::string> keys_not_shown(const Scene& scene, bool is_page) {
  const FinishSettings& finish = scene.finish;
  const std::vector<std::pair<const char*, bool>> said = {
      {"camera.near", scene.camera && scene.camera->near_limit},
      {"camera.far", scene.camera && scene.camera->far_limit},
      {"stereo", scene.stereo.has_value()},
      {"image.background_image", !scene.image.background_image.empty()},
      {"kernel.cut", scene.kernel.cut.has_value()},
      {"kernel.min_radius", scene.kernel.min_radius_pixels > 0},
      {"finish.title", !is_page && !finish.title.text.empty()},
      {"finish.label", !finish.label.text.empty()},
      {"finish.caption", !finish.caption.text.empty()},
      {"finish.color_bar", finish.color_bar.show},
      {"finish.inset", finish.inset.show},
      {"finish.cross_fade", finish.cross_fade.amount > 0},
      {"finish.fade", finish.fade > 0},
      {"path", scene.path.is_set()}};
  std::vector<std::string> keys;
  for (const auto& [key, is_said] : said) {
    if (is_said) keys.emplace_back(key);
  }
  return keys;
}

// One view, without what lies over it.
Scene plain(Scene scene) {
  scene.stereo.reset();
  scene.finish.inset = {};
  scene.finish.color_bar = {};
  scene.finish.label = scene.finish.caption = {};
  scene.image.background_image.clear();
  if (scene.camera && !scene.camera->fade.is_set()) {
    scene.camera->near_limit.reset();
    scene.camera->far_limit.reset();
  }
  return scene;
}

Image light_of(FrameDrawer& drawer, const Scene& scene, const Frame& frame,
               const SnapshotInfo& snapshot, FinishSettings& finish) {
  DrawnFrame drawn = drawer.draw(scene, frame, snapshot);
  if (drawn.finish) finish = *drawn.finish;
  return std::move(drawn.pictures.front().light);
}

// Of the splats; where their order counts, one channel after the other.
Image light_of_splats(FrameDrawer& drawer, const Scene& scene, const Frame& frame,
                      const SnapshotInfo& snapshot, const PackedSplats& packed) {
  FinishSettings ignored;
  const std::vector<LightSplat> splats = unpack(packed);
  if (!is_ordered(frame))
    return light_of(drawer, scene, as_on_page(frame, splats), snapshot, ignored);
  Image light(frame.width, frame.height);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const Image drawn =
        light_of(drawer, scene, as_on_page(frame, splats, channel), snapshot, ignored);
    for (std::size_t i = channel; i < light.pixels.size(); i += 4)
      light.pixels[i] = drawn.pixels[i];
  }
  return light;
}

void measure_difference(const Image& page, const Image& exact, WebPage& of_page) {
  const double white =
      of_page.finish.white.value_or(1) * std::exp2(-of_page.finish.exposure.value_or(0));
  double sum = 0, largest = 0;
  for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
    if (i % 4 == 3) continue;
    const double difference =
        static_cast<double>(page.pixels[i]) - static_cast<double>(exact.pixels[i]);
    sum += difference * difference;
    largest = std::max(largest, std::abs(difference));
  }
  const double values = 0.75 * static_cast<double>(exact.pixels.size());
  of_page.rms_difference = std::sqrt(sum / std::max(values, 1.0)) / white;
  of_page.largest_difference = largest / white;
}

FrameDrawerOptions drawer_options(const PublishOptions& options) {
  FrameDrawerOptions of_drawer;
  of_drawer.device = options.device;
  of_drawer.by_reference = options.reference;
  of_drawer.tree = TreeUse::never;
  of_drawer.light = PictureLight::drawn;
  of_drawer.start_compiler = compiler_processes(nullptr);
  return of_drawer;
}

void publish_page(const std::filesystem::path& path, const Scene& scene, const Frame& frame,
                  const SnapshotInfo& snapshot, const PackedSplats& packed, WebPage page,
                  FrameDrawer& drawer, Console& console) {
  console.status("drawing what the page is compared with");
  const Image exact = light_of(drawer, scene, as_on_page(frame), snapshot, page.finish);
  const Image shown = light_of_splats(drawer, scene, frame, snapshot, packed);
  measure_difference(shown, exact, page);

  const std::string text = make_web_page(page, frame, packed);
  UnfinishedFile file(path);
  file.write(text.data(), text.size());
  file.finish();
  if (text.size() > most_page_bytes)
    console.note(fmt::format("the page has {:.0f} MB; --splats makes it smaller",
                             1e-6 * static_cast<double>(text.size())));
  console.done(fmt::format(
      "{}: {} splats for {} particles, {:.1f} MB; from the particles they differ "
      "by {:.2g} of white (rms), {:.2g} at most",
      path.string(), packed.count(), page.particles, 1e-6 * static_cast<double>(text.size()),
      page.rms_difference, page.largest_difference));
}

}  // namespace

int run_publish(const PublishOptions& options, Console& console) {
  refuse_beside_reference(options, {});
  const std::filesystem::path path = page_path(options.output);
  check_page_path(path);
  const SceneWithSnapshot source = open_scene(options.scene, settings_of(options));
  console.note_each_once(source.notes);
  check_outputs({{path, "--output"}},
                [&] { return files_read(options.scene, source.scene, *source.snapshot); });
  const bool is_page = !is_splat_file(path);
  const Scene scene = is_page ? plain(source.scene) : as_compared(plain(source.scene));
  const SnapshotInfo& snapshot = source.snapshot->info();
  const std::vector<std::string> not_shown = keys_not_shown(source.scene, is_page);
  if (!not_shown.empty())
    console.note(fmt::format("what is published does not show {}", fmt::join(not_shown, ", ")));

  std::vector<std::string> notes = snapshot.notes;
  const LoadProgress progress = [&](const std::string& what, double fraction) {
    console.progress(what, fraction);
  };
  const Frame frame = load_frame(scene, *source.snapshot, notes, progress);
  console.note_each_once(notes);
  is_page ? check_page(frame) : check_splat_file(frame);

  console.status(fmt::format("merging {} particles", particle_count(frame)));
  const std::vector<LightSplat> particles = light_splats(frame);
  const std::vector<LightSplat> splats = merge_splats(
      particles, options.splats.value_or(is_page ? splats_of_pages : splats_for_viewers));
  FrameDrawer drawer(drawer_options(options));
  if (!is_page) {
    publish_splats(path, scene, frame, snapshot, splats, particles.size(), drawer, console);
    return 0;
  }
  WebPage page;
  page.title = options.title.value_or(scene.finish.title.text.empty()
                                          ? options.scene.stem().string()
                                          : replace_placeholders(scene.finish.title.text, snapshot,
                                                                 scene.finish.frame.value_or(0),
                                                                 "finish.title.text"));
  page.unit = length_unit(snapshot);
  page.gamma = scene.image.gamma;
  page.particles = particles.size();
  publish_page(path, scene, frame, snapshot, pack(splats), page, drawer, console);
  return 0;
}

}  // namespace splotchcl::cli
