#include "cli/frame_loop.h"

#include <fmt/format.h>

#include <cmath>
#include <csignal>
#include <utility>

#include "splotchcl/error.h"
#include "splotchcl/image_file.h"
#include "splotchcl/load.h"
#include "splotchcl/reference.h"

namespace splotchcl::cli {
namespace {

volatile std::sig_atomic_t is_stopped = 0;

void stop_after_frame(int) {
  is_stopped = 1;
}

// While it lives, the first Ctrl-C only asks for an end.
class StopSignals {
 public:
  StopSignals() {
    struct sigaction action = {};
    action.sa_handler = stop_after_frame;
    action.sa_flags = SA_RESETHAND | SA_RESTART;
    ::sigaction(SIGINT, &action, &interrupt_);
    ::sigaction(SIGTERM, &action, &terminate_);
  }
  ~StopSignals() {
    ::sigaction(SIGINT, &interrupt_, nullptr);
    ::sigaction(SIGTERM, &terminate_, nullptr);
  }
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

 private:
  struct sigaction interrupt_ = {}, terminate_ = {};
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

}  // namespace

void FrameLoop::draw(const std::vector<int>& frames) {
  if (frames.empty()) return;
  const StopSignals signals;
  if (!options_.reference) {
    console_.status("starting the device");
    renderer_.emplace(RendererOptions{options_.device, CompositeShape::automatic});
  }
  tell(film_.notes());
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

void FrameLoop::show_progress(int frame, std::size_t done, std::size_t total, double seconds) {
  std::string left;
  if (done > 0) {
    const double per_frame = seconds / static_cast<double>(done);
    left = ", " + duration(per_frame * static_cast<double>(total - done)) + " left";
  }
  console_.status(fmt::format("{} frame {}, {} of {}{}", progress_bar(done, total), frame, done + 1,
                              total, left));
}

void FrameLoop::tell(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) {
    if (told_.insert(note).second) console_.note(note);
  }
}

void FrameLoop::draw_frame(int frame) {
  const Scene scene = film_.scene_at(frame);
  const std::shared_ptr<const Snapshot> snapshot = film_.snapshot_at(scene);
  std::vector<std::string> notes;
  const Frame loaded = load_frame(scene, *snapshot, notes);
  std::vector<Picture> pictures = draw_pictures(
      scene, loaded, snapshot->info(), [this](const Frame& view) { return draw_view(view); }, notes,
      film_.other_scenes());
  tell(notes);
  wait_for_writing();
  writing_ = std::async(std::launch::async, [this, frame, scene, drawn = std::move(pictures)] {
    write(frame, scene, drawn);
  });
}

Image FrameLoop::draw_view(const Frame& view) {
  if (!renderer_) return reference::render(view).to_float();
  Image image = renderer_->render(view);
  const RenderStats& stats = renderer_->stats();
  if (stats.bad_particles > 0 && !has_told_bad_) {
    has_told_bad_ = true;
    console_.note(
        fmt::format("{} of {} particles are left out for their bad values; splotchcl render tells "
                    "which, splotchcl info counts them",
                    stats.bad_particles, stats.particles));
  }
  return image;
}

void FrameLoop::write(int frame, const Scene& scene, const std::vector<Picture>& pictures) const {
  ImageFileOptions file;
  file.gamma = scene.image.gamma;
  file.truncates = scene.image.convention == PixelConvention::original;
  file.metadata = {{"splotchcl:version", SPLOTCHCL_VERSION},
                   {"splotchcl:frame", std::to_string(frame)}};
  for (const Picture& picture : pictures)
    write_image(files_.picture(frame, picture.suffix), picture.image, file);
}

// Throws what writing has thrown.
void FrameLoop::wait_for_writing() {
  if (writing_.valid()) writing_.get();
}

}  // namespace splotchcl::cli
