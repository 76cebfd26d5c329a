#pragma once

#include <future>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/film_scene.h"
#include "film/movie/frame_files.h"
#include "splotchcl/frame.h"
#include "splotchcl/picture.h"
#include "splotchcl/renderer.h"

namespace splotchcl::cli {

// Draws frames of a film one after the other, each written while the next is drawn. Ctrl-C ends
// it after the frame that is being drawn; a second one ends the program.
class FrameLoop {
 public:
  FrameLoop(const MovieOptions& options, FilmScene& film, const FrameFiles& files, Console& console)
      : options_(options), film_(film), files_(files), console_(console) {}

  // Throws DataError where it was stopped.
  void draw(const std::vector<int>& frames);

 private:
  void draw_frame(int frame);
  Image draw_view(const Frame& view);
  void write(int frame, const Scene& scene, const std::vector<Picture>& pictures) const;
  void wait_for_writing();
  void show_progress(int frame, std::size_t done, std::size_t total, double seconds);
  void tell(const std::vector<std::string>& notes);

  const MovieOptions& options_;
  FilmScene& film_;
  const FrameFiles& files_;
  Console& console_;
  std::optional<Renderer> renderer_;  // none: the reference draws
  std::set<std::string> told_;        // notes are told once in a film
  bool has_told_bad_ = false;
  std::future<void> writing_;
};

}  // namespace splotchcl::cli
