#pragma once

#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "film/frames/film_tone.h"
#include "splotchcl/frame_drawer.h"
#include "splotchcl/scene.h"

namespace splotchcl {

// Draws frames of a film one after the other. Each is written while the next is drawn, and what
// the user should know is told once in the film, bad particles as of the first frame that has
// some.
class FilmDrawer {
 public:
  // `note` takes a line. Throws as FrameDrawer.
  FilmDrawer(const FrameDrawerOptions& options, std::function<void(const std::string&)> note);
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

  // The frame of this number as the scene shows it, to picture_path(output, ...), or to nowhere
  // where another rank writes it: an empty path. With moments it is their mean light. What it took.
  // `before_writing` may throw what is wrong with what the frame was drawn from. Throws as
  // FrameDrawer::draw, and what writing an earlier frame has thrown.
  RenderStats draw(int frame, const Scene& scene, const Snapshot& snapshot,
                   const std::vector<Moment>& moments, OtherScenes& other_scenes,
                   const std::filesystem::path& output,
                   const std::function<void()>& before_writing);
  // All frames are written. Throws what writing has thrown.
  void finish();

  void tell(const std::vector<std::string>& notes);

 private:
  Scene with_known_tone(int frame, Scene scene) const;
  void tell_of_bad_particles(const DrawnFrame& drawn);

  FrameDrawer drawer_;
  std::function<void(const std::string&)> note_;
  FilmTone tone_;
  std::set<std::string> told_;
  bool has_told_bad_ = false;
  std::future<void> writing_;
};

}  // namespace splotchcl
