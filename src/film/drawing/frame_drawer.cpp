#include "splotchcl/frame_drawer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <future>
#include <memory>
#include <new>
#include <utility>

#include "common/guards.h"
#include "common/words.h"
#include "film/drawing/tree_choice.h"
#include "parallel/ordered_tasks.h"
#include "pictures/other_scenes.h"
#include "ranks/spread_particles.h"
#include "splotchcl/error.h"
#include "splotchcl/load.h"
#include "splotchcl/reference.h"
#include "tree/merged_drawing.h"
#include "tree/tree_cut.h"
#include "tree/tree_preview.h"

namespace splotchcl {
namespace {

// Of several views the one that keeps its promise least well counts.
void add(const FrameCheck& frame, FrameCheck& total) {
  if (frame.errors_of_promise.empty()) return;
  const bool is_worse = total.errors_of_promise.empty() ||
                        frame.errors_of_promise.back() > total.errors_of_promise.back();
  if (is_worse) total = frame;
}

void add(const std::vector<StageTime>& frame, std::vector<StageTime>& total) {
  for (const StageTime& stage : frame) {
    const auto known = std::find_if(total.begin(), total.end(),
                                    [&](const StageTime& s) { return s.stage == stage.stage; });
    if (known == total.end()) {
      total.push_back(stage);
    } else {
      known->seconds += stage.seconds;
    }
  }
}

// Ranks do all that they do for each frame of a picture.
void add(const std::vector<ProcessStats>& frame, std::vector<ProcessStats>& total) {
  if (total.empty()) total.resize(frame.size());
  for (std::size_t r = 0; r < frame.size(); ++r) {
    total[r].host = frame[r].host;
    total[r].particles += frame[r].particles;
    total[r].splats += frame[r].splats;
    total[r].sent_bytes += frame[r].sent_bytes;
    total[r].seconds += frame[r].seconds;
  }
}

// The frames of one picture share their particles.
void add(const RenderStats& frame, RenderStats& total) {
  total.device = frame.device;
  total.note = frame.note;
  total.particles = std::max(total.particles, frame.particles);
  total.bad_particles = std::max(total.bad_particles, frame.bad_particles);
  total.drawn_particles = std::max(total.drawn_particles, frame.drawn_particles);
  total.tile_entries = std::max(total.tile_entries, frame.tile_entries);
  total.blocks_left_out += frame.blocks_left_out;
  total.windows = std::max(total.windows, frame.windows);
  total.drawn_most_exactly |= frame.drawn_most_exactly;
  total.device_bytes = std::max(total.device_bytes, frame.device_bytes);
  add(frame.check, total.check);
  add(frame.processes, total.processes);
  total.build_seconds += frame.build_seconds;
  total.total_seconds += frame.total_seconds;
  add(frame.stages, total.stages);
  add(frame.serial, total.serial);
  total.spans.insert(total.spans.end(), frame.spans.begin(), frame.spans.end());
}

// Eyes, faces and insets together.
void add(const MergedDrawing& frame, TreeStats& total) {
  total.nodes += frame.nodes;
  total.particles += frame.particles;
  total.visited += frame.visited;
  total.bytes += frame.bytes;
  total.estimate = std::max(total.estimate, frame.estimate);
  total.cuts += frame.cuts;
  total.verified_blocks += frame.verified_blocks;
  total.found = std::max(total.found, frame.found);
}

std::optional<std::string> tell_of_bad_particles(const RenderStats& stats) {
  if (stats.bad_particles == 0) return std::nullopt;
  return fmt::format(
      "{} of {} particles are left out: their position, smoothing length, weight, colour, "
      "intensity or sort field is not finite, the smoothing length not above 0, or the weight "
      "or own colour below 0",
      stats.bad_particles, stats.particles);
}

// The ranks that have the particles of a frame wait for each other while they draw. What they have
// not agreed upon nobody else could hear of.
template <class Draw>
auto all_or_none(const Frame& frame, const Draw& draw) -> decltype(draw()) {
  if (!frame.spread) return draw();
  constexpr int failed = 1;
  Communicator& ranks = frame.spread->ranks();
  try {
    return draw();
  } catch (const std::exception& failure) {
    if (dynamic_cast<const AgreedFailure*>(&failure) != nullptr) throw;
    const bool is_memory = dynamic_cast<const std::bad_alloc*>(&failure) != nullptr;
    std::string line = fmt::format(
        "splotchcl: process {} on {}: {}", ranks.rank(), ranks.host(),
        is_memory ? "out of memory; fewer particles, a smaller picture or fewer processes on one "
                    "machine need less"
                  : failure.what());
    // What a compiler says has several.
    std::replace(line.begin(), line.end(), '\n', ' ');
    std::fputs((printable(line) + "\n").c_str(), stderr);
    ranks.abort(failed);
    throw;  // not reached
  }
}

// Of what was asked to be certified.
constexpr const char* no_bound_of_colors =
    "no bound can be given for roundings of this frame's colors, and its errors are estimates: a "
    "palette comes close to black elsewhere than at its first color, or a channel is opaque before "
    "light of another; with a palette that does not, and an absorption alike in all channels, "
    "there "
    "is one";

}  // namespace

std::vector<std::string> DrawnFrame::all_notes() const {
  std::vector<std::string> all = notes;
  if (bad_particles) all.push_back(*bad_particles);
  return all;
}

struct FrameDrawer::State {
  explicit State(const FrameDrawerOptions& options)
      : progress(options.progress), light(options.light), tree(options.tree) {
    plan_options.certify = options.certify;
    if (options.by_reference) return;
    const auto open = [of_renderer = renderer_options(options)] {
      const QuietErrors quiet;
      return std::make_shared<Renderer>(of_renderer);
    };
    renderer = options.opens_later ? in_background(open).share()
                                   : std::async(std::launch::deferred, open).share();
    if (!options.opens_later) renderer.get();
  }

  RendererOptions renderer_options(const FrameDrawerOptions& options) {
    RendererOptions of_renderer;
    of_renderer.device = options.device;
    of_renderer.certify = options.certify;
    of_renderer.shape = options.shape;
    of_renderer.columns_stay = options.columns_stay;
    of_renderer.memory_bytes = options.memory_bytes;
    of_renderer.ranks = options.ranks;
    of_renderer.start_compiler = options.start_compiler;
    of_renderer.progress = [this](double fraction) {
      if (progress) progress("drawing", fraction);
    };
    return of_renderer;
  }

  Image draw_view(const Frame& view, DrawnFrame& drawn) {
    if (!renderer.valid()) return draw_with_reference(view, drawn.stats);
    if (draws_tree(view)) {
      if (auto merged = draw_merged(
              view, [&](const Frame& f) { return draw_alone(f, drawn.stats); },
              tree == TreeUse::automatic)) {
        add(*merged, drawn.tree);
        drawn.notes.emplace_back(
            "drawn from the tree of merged particles: its tolerance is an estimate, checked on "
            "blocks of the picture; --tree never draws the particles");
        return std::move(merged->image);
      }
      drawn.notes.push_back(
          "the tree of merged particles does not serve this picture: so many nodes that it keeps "
          "its tolerance would take longer than all particles, which were drawn");
    }
    return draw_alone(view, drawn.stats);
  }

  bool draws_tree(const Frame& view) const {
    if (plan_options.certify) return false;
    if (tree == TreeUse::only && !has_served_component(view)) {
      throw UsageError(
          "--tree only: found a scene that no tree serves, expected one with kernel.footprint "
          "above 0 and a tree beside its snapshot (splotchcl tree); docs/tree.md tells what else");
    }
    return uses_tree(view, tree);
  }

  bool may_draw_tree(const Frame& frame) const {
    return renderer.valid() && !plan_options.certify && may_use_tree(frame, tree);
  }

  // Of a frame with a tree of merged particles.
  Image draw_roughly(const Frame& frame, std::uint64_t splats, TreePreview& preview) const {
    RenderStats ignored;
    const std::optional<Frame> nodes = preview.of(frame, splats);
    return draw_alone(nodes ? *nodes : frame, ignored);
  }

  LooseDrawing loose_drawing() {
    constexpr std::uint64_t rough_splats = 200000;
    LooseDrawing loose;
    loose.serves = [this](const Frame& frame) { return may_draw_tree(frame); };
    loose.draw_roughly = [this](const Frame& frame) {
      TreePreview preview;
      return draw_roughly(frame, rough_splats, preview);
    };
    return loose;
  }

  // All that tells how bright a picture is.
  Image draw_for_tone(const Frame& view, DrawnFrame& drawn) {
    if (!may_draw_tree(view)) return draw_view(view, drawn);
    constexpr std::uint64_t splats_of_pixel = 4;
    const auto pixels =
        static_cast<std::uint64_t>(view.crop.width) * static_cast<std::uint64_t>(view.crop.height);
    return draw_roughly(view, splats_of_pixel * pixels, tone_preview);
  }

  Image draw_alone(const Frame& view, RenderStats& total) const {
    const QuietErrors quiet;
    RenderStats stats;
    Image image = draw_with_device(view, stats);
    add(stats, total);
    return image;
  }

  // What is found of errors counts in units of what is shown as white (units_of_white.h). A map of
  // them needs drawings that count them so from the start.
  bool keeps_promise(double gain, DrawnFrame& drawn) const {
    if (!renderer.valid()) return true;  // the reference has none
    std::vector<double>& errors = drawn.stats.check.errors_of_promise;
    const bool is_kept = !plan_options.certify && !errors.empty() &&
                         keeps_promise_at(gain, errors.back()) && gain * drawn.tree.found <= 1;
    if (is_kept) {
      errors.back() *= gain;
      drawn.tree.found *= gain;
      drawn.tree.estimate *= gain;
    } else {
      drawn.stats.check = {};
      drawn.tree = {};
    }
    return is_kept;
  }

  bool is_open() const {
    return renderer.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  }

  Image draw_with_device(const Frame& view, RenderStats& stats) const {
    if (is_open()) return renderer.get()->render(view, stats);
    // While the device is opened. Alone: glibc makes no thread while another loads a library.
    constexpr bool on_all_cores = false;
    const FramePlan plan = Renderer::first_plan(view, plan_options, on_all_cores);
    return renderer.get()->render(view, plan, stats);
  }

  Image draw_with_reference(const Frame& view, RenderStats& total) const {
    if (view.spread) {
      throw UsageError(
          "found particles that are spread over processes, expected those of one: the reference "
          "draws alone");
    }
    const auto start = std::chrono::steady_clock::now();
    RenderStats stats;
    stats.device = "reference";
    stats.particles = particle_count(view);
    stats.bad_particles = reference::count_bad(view);
    stats.drawn_particles = reference::project(view).size();
    Image image = reference::render(view, [this](double fraction) {
                    if (progress) progress("drawing with the reference", fraction);
                  }).to_float();
    stats.total_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    add(stats, total);
    return image;
  }

  std::optional<FinishSettings> find_finish(const Scene& scene, const Frame& frame,
                                            const SnapshotInfo& snapshot,
                                            OtherScenes& other_scenes) {
    DrawnFrame drawn;
    DrawnPictures pictures = draw_pictures(
        scene, frame, snapshot, [&](const Frame& view) { return draw_for_tone(view, drawn); },
        drawn.notes, other_scenes, light, {}, {}, {});
    if (pictures.is_black) return std::nullopt;
    return std::move(pictures.finish);
  }

  DrawnFrame draw(const Scene& scene, const Frame& frame, const SnapshotInfo& snapshot,
                  OtherScenes& other_scenes, std::vector<std::string> notes,
                  const std::vector<Moment>& moments = {}) {
    DrawnFrame drawn;
    drawn.notes = std::move(notes);
    DrawnPictures pictures = draw_pictures(
        scene, frame, snapshot, [&](const Frame& view) { return draw_view(view, drawn); },
        drawn.notes, other_scenes, light, [&](double gain) { return keeps_promise(gain, drawn); },
        moments, loose_drawing());
    if (!drawn.stats.spans.empty())
      drawn.stats.spans.push_back(
          {"finish", false, drawn.stats.spans.back().end, std::chrono::steady_clock::now()});
    drawn.pictures = std::move(pictures.pictures);
    if (!pictures.is_black) drawn.finish = std::move(pictures.finish);
    if (!drawn.stats.note.empty()) drawn.notes.push_back(drawn.stats.note);
    drawn.bad_particles = tell_of_bad_particles(drawn.stats);
    if (plan_options.certify && renderer.valid() && !drawn.stats.check.is_bound)
      drawn.notes.emplace_back(no_bound_of_colors);
    return drawn;
  }

  std::function<void(const std::string&, double)> progress;
  PictureLight light;
  PlanOptions plan_options;
  TreeUse tree = TreeUse::automatic;
  TreePreview tone_preview;  // every process of a film draws the same frames for tone, in order
  std::shared_future<std::shared_ptr<Renderer>> renderer;  // none: the reference draws
};

FrameDrawer::FrameDrawer(const FrameDrawerOptions& options)
    : state_(std::make_unique<State>(options)) {}
FrameDrawer::~FrameDrawer() = default;
FrameDrawer::FrameDrawer(FrameDrawer&&) noexcept = default;
FrameDrawer& FrameDrawer::operator=(FrameDrawer&&) noexcept = default;

void FrameDrawer::check_device() const {
  if (state_->renderer.valid() && state_->is_open()) state_->renderer.get();
}

void FrameDrawer::keep(PictureLight light) {
  state_->light = light;
}

DrawnFrame FrameDrawer::draw(const Scene& scene, const Snapshot& snapshot) {
  OtherScenes none_kept;
  return draw(scene, snapshot, none_kept);
}

DrawnFrame FrameDrawer::draw(const Scene& scene, const Snapshot& snapshot,
                             OtherScenes& other_scenes, const std::vector<Moment>& moments) {
  std::vector<std::string> notes;
  const Frame frame = load_frame(scene, snapshot, notes, state_->progress);
  return draw(scene, frame, snapshot.info(), other_scenes, std::move(notes), moments);
}

std::optional<FinishSettings> FrameDrawer::find_finish(const Scene& scene, const Snapshot& snapshot,
                                                       OtherScenes& other_scenes) {
  std::vector<std::string> ignored;  // told where the frame is drawn
  const Frame frame = load_frame(scene, snapshot, ignored, state_->progress);
  return all_or_none(
      frame, [&] { return state_->find_finish(scene, frame, snapshot.info(), other_scenes); });
}

DrawnFrame FrameDrawer::draw(const Scene& scene, const Frame& frame, const SnapshotInfo& snapshot) {
  OtherScenes none_kept;
  return draw(scene, frame, snapshot, none_kept, {});
}

DrawnFrame FrameDrawer::draw(const Scene& scene, const Frame& frame, const SnapshotInfo& snapshot,
                             OtherScenes& other_scenes, std::vector<std::string> notes,
                             const std::vector<Moment>& moments) {
  return all_or_none(frame, [&] {
    return state_->draw(scene, frame, snapshot, other_scenes, std::move(notes), moments);
  });
}

ImageFileOptions image_file_options(const Scene& scene,
                                    std::map<std::string, std::string> metadata) {
  ImageFileOptions options;
  options.gamma = scene.image.gamma;
  options.truncates = scene.image.convention == PixelConvention::original;
  options.bits = scene.image.bits;
  options.dithers = scene.image.dither.value_or(!options.truncates);
  options.metadata = std::move(metadata);
  options.metadata["splotchcl:version"] = SPLOTCHCL_VERSION;
  const FinishSettings& finish = scene.finish;
  if (finish.exposure) options.metadata["splotchcl:exposure"] = fmt::format("{}", *finish.exposure);
  if (finish.white) options.metadata["splotchcl:white"] = fmt::format("{}", *finish.white);
  return options;
}

PictureLight light_of_file(const std::filesystem::path& output) {
  constexpr int whole_numbers = 16;
  if (!holds_floats(output, std::nullopt)) return PictureLight::shown;
  return holds_floats(output, whole_numbers) ? PictureLight::drawn : PictureLight::both;
}

void write_pictures(const std::filesystem::path& output, const std::vector<Picture>& pictures,
                    const ImageFileOptions& options) {
  for (const Picture& picture : pictures) {
    ImageFileOptions with_places = options;
    with_places.places = picture.places;
    const bool is_as_drawn = !picture.light.pixels.empty() && holds_floats(output, options.bits);
    with_places.metadata["splotchcl:light"] =
        is_as_drawn ? "scene-linear, exposure not applied" : "linear, as displayed";
    write_image(picture_path(output, picture.suffix), is_as_drawn ? picture.light : picture.image,
                with_places);
  }
}

}  // namespace splotchcl
