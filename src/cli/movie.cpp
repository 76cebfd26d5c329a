#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <future>
#include <optional>
#include <set>
#include <sstream>

#include "cli/commands.h"
#include "cli/film_inputs.h"
#include "cli/film_scene.h"
#include "io/movie/encoder.h"
#include "io/movie/frame_files.h"
#include "io/movie/frame_range.h"
#include "splotchcl/error.h"
#include "splotchcl/image_file.h"
#include "splotchcl/picture.h"
#include "splotchcl/reference.h"
#include "splotchcl/renderer.h"
#include "splotchcl/scene_file.h"

namespace splotchcl::cli {
namespace {

// Ctrl-C ends the film after the frame that is being drawn. A second one ends the program.
volatile std::sig_atomic_t is_stopped = 0;

void stop_after_frame(int) {
  is_stopped = 1;
}

void watch_for_stop() {
  struct sigaction action = {};
  action.sa_handler = stop_after_frame;
  action.sa_flags = SA_RESETHAND | SA_RESTART;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

std::vector<PictureSize> sizes_of(const Scene& scene) {
  return picture_sizes(scene, scene.image.width, scene.image.height);
}

std::vector<std::string> suffixes_of(const Scene& scene) {
  std::vector<std::string> suffixes;
  for (const PictureSize& size : sizes_of(scene))
    suffixes.push_back(size.suffix);
  return suffixes;
}

// Everything that the pictures can fail by is tried before anything is read.
void check_pictures(const FrameFiles& files, const Scene& scene) {
  files.check();
  for (const PictureSize& size : sizes_of(scene)) {
    if (files.is_film()) {
      check_film(files.film(size.suffix), scene.movie, size.width, size.height);
    } else {
      check_image_size(files.picture(0, size.suffix), size.width, size.height);
    }
  }
}

// All that the frames depend on, but for the device: its frames are the same within the
// tolerance.
std::string manifest_of(FilmScene& film, bool by_reference) {
  Scene scene = film.scene();
  std::string text =
      fmt::format("splotchcl {}, {}\n", SPLOTCHCL_VERSION, by_reference ? "reference" : "device");
  for (const std::string& input : film_inputs(scene, film.path()))
    text += "input " + input + "\n";
  scene.movie = {};
  scene.path = {};
  text += format_scene(scene);
  for (int frame = 0; frame < film.path().frame_count(); ++frame) {
    text += fmt::format("frame {}: {}\n", frame, fmt::join(film.path().settings(frame), "; "));
  }
  return text;
}

// Notes are told once in a film.
class Notes {
 public:
  explicit Notes(Console& console) : console_(console) {}
  void tell(const std::vector<std::string>& notes) {
    for (const std::string& note : notes) {
      if (told_.insert(note).second) console_.note(note);
    }
  }

 private:
  Console& console_;
  std::set<std::string> told_;
};

std::string duration(double seconds) {
  const auto whole = static_cast<long>(std::lround(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  return fmt::format("{}:{:02} h", whole / 3600, whole / 60 % 60);
}

std::string progress_bar(std::size_t done, std::size_t total) {
  constexpr std::size_t width = 24;
  const std::size_t filled = width * done / total;
  return "[" + std::string(filled, '#') + std::string(width - filled, '.') + "]";
}

// The frames that are missing are drawn one after the other, each written while the next is
// drawn.
class FrameLoop {
 public:
  FrameLoop(const MovieOptions& options, FilmScene& film, const FrameFiles& files, Console& console)
      : options_(options), film_(film), files_(files), console_(console), notes_(console) {}

  void draw(const std::vector<int>& frames) {
    if (frames.empty()) return;
    if (!options_.reference) {
      console_.status("starting the device");
      renderer_.emplace(RendererOptions{options_.device, CompositeShape::automatic});
    }
    notes_.tell(film_.notes());
    const Stopwatch stopwatch;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      show_progress(frames[i], i, frames.size(), stopwatch.seconds());
      draw_frame(frames[i]);
      if (is_stopped != 0) break;
    }
    wait_for_writing();
    if (is_stopped == 0) return;
    throw DataError(
        "stopped; the frames that were drawn are kept, and the same command goes on with the next");
  }

 private:
  void show_progress(int frame, std::size_t done, std::size_t total, double seconds) {
    std::string left;
    if (done > 0) {
      const double per_frame = seconds / static_cast<double>(done);
      left = ", " + duration(per_frame * static_cast<double>(total - done)) + " left";
    }
    console_.status(fmt::format("{} frame {}, {} of {}{}", progress_bar(done, total), frame,
                                done + 1, total, left));
  }

  void draw_frame(int frame) {
    const Scene scene = film_.scene_at(frame);
    const std::shared_ptr<const Snapshot> snapshot = film_.snapshot_at(scene);
    std::vector<std::string> notes;
    const Frame loaded = load_frame(scene, *snapshot, notes);
    std::vector<Picture> pictures = draw_pictures(
        scene, loaded, snapshot->info(), [this](const Frame& view) { return draw_view(view); },
        notes, film_.other_scenes());
    notes_.tell(notes);
    wait_for_writing();
    writing_ = std::async(std::launch::async, [this, frame, scene, drawn = std::move(pictures)] {
      write(frame, scene, drawn);
    });
  }

  Image draw_view(const Frame& view) {
    if (!renderer_) return reference::render(view).to_float();
    Image image = renderer_->render(view);
    const RenderStats& stats = renderer_->stats();
    if (stats.bad_particles > 0 && !has_told_bad_) {
      has_told_bad_ = true;
      console_.note(
          fmt::format("{} of {} particles are left out for their bad values; splotchcl "
                      "render tells which, splotchcl info counts them",
                      stats.bad_particles, stats.particles));
    }
    return image;
  }

  void write(int frame, const Scene& scene, const std::vector<Picture>& pictures) const {
    ImageFileOptions file;
    file.gamma = scene.image.gamma;
    file.truncates = scene.image.convention == PixelConvention::original;
    file.metadata = {{"splotchcl:version", SPLOTCHCL_VERSION},
                     {"splotchcl:frame", std::to_string(frame)}};
    for (const Picture& picture : pictures)
      write_image(files_.picture(frame, picture.suffix), picture.image, file);
  }

  // Throws what writing has thrown.
  void wait_for_writing() {
    if (writing_.valid()) writing_.get();
  }

  const MovieOptions& options_;
  FilmScene& film_;
  const FrameFiles& files_;
  Console& console_;
  Notes notes_;
  std::optional<Renderer> renderer_;
  bool has_told_bad_ = false;
  std::future<void> writing_;
};

// The bytes that a PNG file holds.
std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path) {
  const Image image = read_image(path);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(image.pixels.size() / 4 * 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (i % 4 != 3) bytes.push_back(static_cast<std::uint8_t>(255 * image.pixels[i] + 0.5F));
  }
  return bytes;
}

void join(const std::vector<int>& frames, const Scene& scene, const FrameFiles& files,
          Console& console) {
  for (const PictureSize& size : sizes_of(scene)) {
    Encoder encoder(files.film(size.suffix), scene.movie, size.width, size.height, files.folder());
    for (std::size_t i = 0; i < frames.size(); ++i) {
      console.progress("joining the frames",
                       static_cast<double>(i) / static_cast<double>(frames.size()));
      encoder.add(read_bytes(files.picture(frames[i], size.suffix)));
    }
    encoder.finish();
  }
}

std::vector<int> missing(const std::vector<int>& frames, const FrameFiles& files) {
  std::vector<int> result;
  std::copy_if(frames.begin(), frames.end(), std::back_inserter(result),
               [&](int frame) { return !files.has(frame); });
  return result;
}

// Makes the film where all its frames are there; else says what to do.
void complete(const MovieOptions& options, const std::vector<int>& frames, const Scene& scene,
              FrameFiles& files, Console& console) {
  const std::size_t lacking = missing(frames, files).size();
  if (lacking > 0 && options.join) {
    throw DataError(fmt::format("{}: {} of {} frames are missing; draw the parts that are left",
                                files.folder().string(), lacking, frames.size()));
  }
  if (lacking > 0) {
    console.done(
        fmt::format("part {} is drawn; the last part, or splotchcl movie --join, makes "
                    "the film",
                    options.part));
    return;
  }
  const FrameFiles::Lock lock(files);
  if (!lock) return;  // another part is at it
  if (files.is_film()) join(frames, scene, files, console);
  files.close();
  console.done(fmt::format("{}: {} frames of {}x{} pixels", options.output.string(), frames.size(),
                           scene.image.width, scene.image.height));
}

// The last part has made the film already, or nobody has begun it.
void tell_of_nothing_to_join(const MovieOptions& options, const std::vector<int>& frames,
                             const FrameFiles& files, Console& console) {
  if (!files.is_complete(frames)) {
    throw DataError(options.output.string() +
                    ": found no frames to join, expected those of its parts; draw them first");
  }
  console.done(options.output.string() + " is complete already");
}

std::vector<std::string> settings_of(const MovieOptions& options) {
  std::vector<std::string> settings = options.settings;
  if (options.tolerance) settings.push_back(fmt::format("tolerance={}", *options.tolerance));
  return settings;
}

}  // namespace

int run_movie(const MovieOptions& options, Console& console) {
  FilmScene film(options.scene, settings_of(options));
  const Scene start = film.path().scene_at(film.scene(), 0);
  FrameFiles files(options.output, suffixes_of(start));
  check_pictures(files, start);
  const std::vector<int> frames = select_frames(options.frames, film.path().frame_count());
  const std::vector<int> part = select_part(options.part, frames);

  if (options.join && !files.is_begun()) {
    tell_of_nothing_to_join(options, frames, files, console);
    return 0;
  }
  console.status("reading");
  film.decide();
  files.open(manifest_of(film, options.reference));
  watch_for_stop();
  if (!options.join) FrameLoop(options, film, files, console).draw(missing(part, files));
  complete(options, frames, start, files, console);
  return 0;
}

}  // namespace splotchcl::cli
