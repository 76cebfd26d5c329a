#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "parallel/ordered_tasks.h"
#include "splotchcl/finish.h"
#include "splotchcl/frame.h"
#include "splotchcl/frame_drawer.h"
#include "splotchcl/picture.h"
#include "splotchcl/scene.h"

namespace splotchcl {

// Exposure and white of a film that leaves them to its pictures, as some of its frames found them.
class FilmTone {
 public:
  // Each with an exposure and a white.
  void add(int frame, const FinishSettings& found) { found_[frame] = found; }
  bool is_empty() const { return found_.empty(); }

  // What the settings leave open. An exposure that follows the film goes straight from one of those
  // frames to the next, in stops, each of which is averaged with its neighbours, so that light
  // never jumps; any other is one for all frames, that of the brightest.
  void give_to(FinishSettings& finish, int frame) const;

 private:
  FinishSettings of_brightest() const;
  FinishSettings following(int frame) const;

  std::map<int, FinishSettings> found_;
};

// The frames, of so many, that are drawn to find it: the first, the last, and some between; of
// short films more where their exposure follows, which may be another in each frame.
std::vector<int> frames_that_decide(int frames, bool follows);

// A frame of a film that has been read, to be drawn.
struct LoadedFrame {
  int number = 0;
  Scene scene;
  std::shared_ptr<const Snapshot> snapshot;  // keeps what the frame points into
  Frame frame;
  std::vector<std::string> notes;
  std::vector<Moment> moments;  // as FrameDrawer::draw has them
  TimeSpan reading;
};

// Draws frames of a film in their order. While the device draws one, the frame before may be
// checked and finished, those before that be written, and the caller may read the next. What the
// user should know is told once in the film, bad particles as of the first frame that has some.
class FilmDrawer {
 public:
  // Who is told: `note` takes a line, `span` when a part of a frame's work was done. Each may be
  // empty, and is called by the thread that calls the functions below.
  struct Report {
    std::function<void(const std::string&)> note;
    std::function<void(int frame, const TimeSpan&)> span;
  };
  // Throws as FrameDrawer.
  FilmDrawer(const FrameDrawerOptions& options, Report report);
  ~FilmDrawer();
  FilmDrawer(const FilmDrawer&) = delete;
  FilmDrawer& operator=(const FilmDrawer&) = delete;

  // Whether the frame leaves exposure or white to pictures: its own, or those of a scene that it
  // fades to and of which none has been drawn.
  static bool asks_for_tone(const Scene& scene, const OtherScenes& other_scenes);
  // Whether no frame has been drawn that could decide what this one leaves open.
  bool lacks_tone(const Scene& scene, const OtherScenes& other_scenes) const;
  // Draws the frame for nothing but that, before any is drawn to be kept. Throws as
  // FrameDrawer::draw.
  void decide_tone(int frame, const Scene& scene, const Snapshot& snapshot,
                   OtherScenes& other_scenes);

  // The frame as the scene shows it, with moments their mean light. Throws as load_frame.
  LoadedFrame load(int frame, Scene scene, std::shared_ptr<const Snapshot> snapshot,
                   std::vector<Moment> moments) const;
  // The frame is drawn in the background.
  void begin(LoadedFrame frame, OtherScenes& other_scenes);
  // Frames that were begun and not ended.
  std::size_t begun() const { return drawing_.size(); }
  // Whether another frame may be read, or begun, before the one begun last has ended: its own
  // drawing reads nothing, and others' pictures do not wait for each other.
  bool may_go_on() const { return may_go_on_; }
  // The first of them is drawn, and is being written to picture_path(output, ...), or nowhere where
  // another rank writes it: an empty path. What it took. `before_writing` may throw what is wrong
  // with what the frame was drawn from. Throws as FrameDrawer::draw, and what writing an earlier
  // frame has thrown.
  std::pair<int, RenderStats> end(const std::function<std::filesystem::path(int frame)>& output,
                                  const std::function<void()>& before_writing);
  // All frames that have ended are written. Throws what writing has thrown.
  void finish();

  void tell(const std::vector<std::string>& notes);

 private:
  struct Drawn {
    int number = 0;
    Scene scene;
    DrawnFrame drawn;
    TimeSpan reading;
  };
  struct Written {
    int frame = 0;
    TimeSpan span;
  };
  Scene with_known_tone(int frame, Scene scene) const;
  void tell_of_bad_particles(const DrawnFrame& drawn);
  void tell_span(int frame, const TimeSpan& span) const;
  void write(int frame, const Scene& scene, std::vector<Picture> pictures,
             const std::filesystem::path& output);
  void end_writing();

  FrameDrawer drawer_;
  Report report_;
  bool draws_alone_;  // the oracle takes all cores, ranks wait for each other
  FilmTone tone_;
  std::set<std::string> told_;
  bool has_told_bad_ = false;
  bool may_go_on_ = true;
  OrderedTasks<Drawn> drawing_;
  OrderedTasks<Written> writing_;
};

}  // namespace splotchcl
