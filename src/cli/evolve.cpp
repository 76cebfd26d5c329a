#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>
#include <set>

#include "cli/commands.h"
#include "common/file_identity.h"
#include "common/output_files.h"
#include "common/unfinished_file.h"
#include "film/frames/film_drawer.h"
#include "film/movie/frame_files.h"
#include "open_scene/input_files.h"
#include "pictures/other_scenes.h"
#include "scene/constants.h"
#include "snapshot/derived_snapshots.h"
#include "snapshot/load_memory.h"
#include "splotchcl/error.h"
#include "splotchcl/image_file.h"
#include "splotchcl/load.h"
#include "splotchcl/open_scene.h"
#include "splotchcl/picture.h"
#include "splotchcl/snapshot_file.h"
#include "splotchcl/turning_galaxy.h"

namespace splotchcl::cli {
namespace {

bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code error;
  return std::filesystem::equivalent(a, b, error) && !error;
}

// How fast it turns; the step follows from the time that is drawn.
TurningSettings turning_settings(const EvolveOptions& options) {
  TurningSettings settings;
  if (options.first_order) settings.integrator = OrbitIntegrator::first_order;
  settings.pattern_speed = options.pattern_speed;
  if (options.rotation_curve) {
    settings.curve = read_rotation_curve(*options.rotation_curve);
  } else if (options.speed || options.core) {
    settings.curve = RotationCurve::flat(options.speed.value_or(200), options.core.value_or(1));
  }
  return settings;
}

// One turn of a pattern ends as it begins.
double default_duration(std::optional<double> hold_myr, const TurningSettings& settings) {
  constexpr double where_all_turns_alike = 200;
  if (settings.pattern_speed) return 2 * pi * myr_per_kpc_s_km / *settings.pattern_speed;
  return hold_myr.value_or(where_all_turns_alike);
}

void check(const EvolveOptions& options) {
  if (!options.output && !options.snapshots) {
    throw UsageError(
        "evolve: there is nothing to make; name pictures with --output, or --snapshots");
  }
  if (options.output && !options.scene) {
    throw UsageError("evolve: --output without a SCENE; name a scene file that draws the galaxy");
  }
  if (options.frames < 1 || options.frames > 1000000) {
    throw UsageError(fmt::format("--frames: found {}, expected 1 to 1000000", options.frames));
  }
  if (options.step_myr && !options.first_order) {
    throw UsageError("--step: only --first-order takes steps; exact circles need none");
  }
  if (options.rotation_curve && (options.speed || options.core)) {
    throw UsageError("--rotation-curve: excludes --speed and --core, which are a curve, too");
  }
  if (options.duration_myr && (!(*options.duration_myr >= 0) || *options.duration_myr > 1e6)) {
    throw UsageError(
        fmt::format("--duration: found {}, expected 0 to 1e6 Myr", *options.duration_myr));
  }
}

// A scene in which the galaxy's snapshot is another one in every frame.
class TurningScene {
 public:
  TurningScene(const EvolveOptions& options, const TurningGalaxy& galaxy) : galaxy_(galaxy) {
    SceneWithSnapshot opened = open_scene(*options.scene, options.settings);
    scene_ = std::move(opened.scene);
    notes_ = std::move(opened.notes);
    const std::vector<std::string>& of_data = opened.snapshot->info().notes;
    notes_.insert(notes_.end(), of_data.begin(), of_data.end());
    files_read_ = [file = *options.scene, scene = scene_, snapshot = opened.snapshot] {
      return splotchcl::files_read(file, scene, *snapshot);
    };
    for (const Component& component : scene_.components) {
      if (is_same_file(component.snapshot, options.galaxy)) paths_.insert(component.snapshot);
    }
    is_main_ = is_same_file(opened.snapshot->info().files.front(), options.galaxy);
    if (!is_main_ && paths_.empty()) {
      throw UsageError(fmt::format(
          "{}: draws {}, expected a scene whose snapshot, or that of a component, is {}",
          options.scene->string(), opened.snapshot->info().files.front().string(),
          options.galaxy.string()));
    }
    if (!is_main_) surroundings_ = std::make_shared<CachedSnapshot>(opened.snapshot);
  }

  const Scene& scene() const { return scene_; }
  OtherScenes& other_scenes() { return other_scenes_; }
  std::set<std::filesystem::path> files_read() const { return files_read_(); }
  // What the user should know of the scene and its data.
  const std::vector<std::string>& notes() const { return notes_; }

  // What the first frame decides holds for all.
  void decide() {
    scene_ = fixed_scene(splotchcl::decide(scene_, *snapshot_at(galaxy_.at(0)), notes_));
    other_scenes_.decide(scene_);
  }

  // What the scene draws when the galaxy has turned.
  std::shared_ptr<const Snapshot> snapshot_at(const std::shared_ptr<const Snapshot>& turned) {
    const std::shared_ptr<const Snapshot> main = is_main_ ? turned : surroundings_;
    for (const std::string& path : paths_)
      main->memory().set_companion(path, turned);
    return main;
  }

 private:
  const TurningGalaxy& galaxy_;
  Scene scene_;
  std::vector<std::string> notes_;
  std::function<std::set<std::filesystem::path>()> files_read_;
  bool is_main_ = false;
  std::set<std::string> paths_;  // of the galaxy, as components name it
  std::shared_ptr<const Snapshot> surroundings_;
  OtherScenes other_scenes_;
};

class Evolution {
 public:
  Evolution(const EvolveOptions& options, Console& console) : options_(options), console_(console) {
    if (options.output) pictures_ = NumberedFiles::require(*options.output, "--output");
    if (options.snapshots) snapshots_ = NumberedFiles::require(*options.snapshots, "--snapshots");
    if (pictures_) check_image_path(pictures_->at(0));
    if (snapshots_) check_output_path(snapshots_->at(0));
  }

  void run() {
    const std::vector<int> part = select_part(options_.part, all_frames());
    console_.status("reading " + options_.galaxy.filename().string());
    inputs_.add(options_.galaxy);
    const auto start = std::make_shared<CachedSnapshot>(open_snapshot(options_.galaxy));
    check_orbits(*start);
    const TurningGalaxy galaxy(start, decide_time(*start));
    if (pictures_) scene_.emplace(options_, galaxy);
    check_files(part, *start);
    watch_files(*start);
    if (pictures_) begin_drawing(galaxy);
    for (const int frame : part) {
      console_.status(fmt::format("frame {} of {}", frame + 1, options_.frames));
      const std::shared_ptr<const Snapshot> turned = galaxy.at(time_of(frame));
      inputs_.check();
      if (snapshots_) {
        write_galaxy_snapshot(snapshots_->at(frame), *turned, time_of(frame));
      }
      if (drawer_) {
        drawer_->begin(drawer_->load(frame, scene_->scene(), scene_->snapshot_at(turned), {}),
                       scene_->other_scenes());
        end_frames(drawer_->may_go_on() ? 1 : 0);
      }
    }
    if (drawer_) {
      end_frames(0);
      drawer_->finish();
    }
    console_.done(part.empty()
                      ? "this part has no frames"
                      : fmt::format("frames {} to {} of {}, {:.4g} Myr in all", part.front(),
                                    part.back(), options_.frames, duration_));
  }

 private:
  TurningSettings decide_time(const Snapshot& galaxy) {
    TurningSettings settings = turning_settings(options_);
    const std::optional<double> hold = arms_hold_myr(galaxy, settings);
    duration_ = options_.duration_myr.value_or(default_duration(hold, settings));
    if (const auto warning = turning_warning(duration_, hold)) console_.note(*warning);
    const double interval = duration_ / std::max(1, options_.frames - 1);
    settings.step_myr = options_.step_myr.value_or(interval > 0 ? interval : 1);
    return settings;
  }
  double time_of(int frame) const {
    return options_.frames == 1 ? duration_ : duration_ * frame / (options_.frames - 1);
  }

  std::vector<int> all_frames() const {
    std::vector<int> frames(static_cast<std::size_t>(options_.frames));
    std::iota(frames.begin(), frames.end(), 0);
    return frames;
  }

  // Nothing that is read is written.
  void check_files(const std::vector<int>& frames, const Snapshot& galaxy) const {
    std::vector<OutputFile> outputs;
    for (const int frame : frames) {
      if (snapshots_) outputs.push_back({snapshots_->at(frame), "--snapshots"});
      if (!pictures_) continue;
      const ImageSettings& image = scene_->scene().image;
      for (const PictureSize& size : picture_sizes(scene_->scene(), image.width, image.height))
        outputs.push_back({picture_path(pictures_->at(frame), size.suffix), "--output"});
    }
    check_outputs(outputs, [&] {
      InputFiles inputs;
      inputs.add(galaxy);
      if (options_.rotation_curve) inputs.add(*options_.rotation_curve);
      std::set<std::filesystem::path> all = inputs.all();
      if (scene_) all.merge(scene_->files_read());
      return all;
    });
  }

  // All moments show the same galaxy before the same surroundings.
  void watch_files(const Snapshot& galaxy) {
    InputFiles inputs;
    inputs.add(galaxy);
    if (options_.rotation_curve) inputs.add(*options_.rotation_curve);
    if (scene_) inputs.add_named_files(scene_->scene());
    for (const std::filesystem::path& file : inputs.with_sets())
      inputs_.add(file);
  }

  void begin_drawing(const TurningGalaxy& galaxy) {
    const ImageSettings& image = scene_->scene().image;
    for (const PictureSize& size : picture_sizes(scene_->scene(), image.width, image.height))
      check_image_size(pictures_->at(0), size.width, size.height);
    check_image_bits(pictures_->at(0), image.bits);
    FrameDrawerOptions of_drawer{options_.device, false, {}};
    of_drawer.light = light_of_file(pictures_->at(0));
    drawer_.emplace(of_drawer, FilmDrawer::Report{
                                   [this](const std::string& note) { console_.note(note); }, {}});
    scene_->decide();
    drawer_->tell(scene_->notes());
    const bool follows = scene_->scene().finish.exposure_follows;
    for (const int frame : frames_that_decide(options_.frames, follows)) {
      if (!FilmDrawer::asks_for_tone(scene_->scene(), scene_->other_scenes())) return;
      console_.status("finding the film's exposure");
      drawer_->decide_tone(frame, scene_->scene(), *scene_->snapshot_at(galaxy.at(time_of(frame))),
                           scene_->other_scenes());
    }
  }

  // All but so many of those that were begun last.
  void end_frames(std::size_t left) {
    while (drawer_->begun() > left)
      drawer_->end([this](int frame) { return pictures_->at(frame); }, [this] { inputs_.check(); });
  }

  const EvolveOptions& options_;
  Console& console_;
  double duration_ = 0;  // Myr
  WatchedFiles inputs_;
  std::optional<NumberedFiles> pictures_, snapshots_;
  std::optional<TurningScene> scene_;
  std::optional<FilmDrawer> drawer_;
};

}  // namespace

int run_evolve(const EvolveOptions& options, Console& console) {
  check(options);
  Evolution(options, console).run();
  return 0;
}

}  // namespace splotchcl::cli
