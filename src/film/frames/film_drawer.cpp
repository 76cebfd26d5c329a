#include "film/frames/film_drawer.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "finish/tone.h"
#include "parallel/in_background.h"
#include "pictures/other_scenes.h"

namespace splotchcl {

FilmDrawer::FilmDrawer(const FrameDrawerOptions& options,
                       std::function<void(const std::string&)> note)
    : drawer_(options), note_(std::move(note)) {}

// The future waits for the frame that is being written.
FilmDrawer::~FilmDrawer() = default;

namespace {

bool leaves_tone_to_pictures(const Scene& scene) {
  const bool is_black = scene.finish.cross_fade.amount == 1 || scene.finish.fade == 1;
  return !is_black && has_open_tone(scene.finish);
}

}  // namespace

bool FilmDrawer::asks_for_tone(const Scene& scene, const OtherScenes& other_scenes) {
  return leaves_tone_to_pictures(scene) || other_scenes.lacks_tone(scene);
}

bool FilmDrawer::lacks_tone(const Scene& scene, const OtherScenes& other_scenes) const {
  return (tone_.is_empty() && leaves_tone_to_pictures(scene)) || other_scenes.lacks_tone(scene);
}

void FilmDrawer::decide_tone(int frame, const Scene& scene, const Snapshot& snapshot,
                             OtherScenes& other_scenes) {
  const DrawnFrame drawn = drawer_.draw(scene, snapshot, other_scenes);
  if (!leaves_tone_to_pictures(scene) || !drawn.finish) return;
  if (!has_open_tone(*drawn.finish)) tone_.add(frame, *drawn.finish);
}

Scene FilmDrawer::with_known_tone(int frame, Scene scene) const {
  tone_.give_to(scene.finish, frame);
  return scene;
}

namespace {

// "HH:MM:SS:FF" of whole frames in a second, as editors count them; none where a second has more
// than two digits count, or less than one.
std::string timecode(int frame, double frames_per_second) {
  const auto rate = static_cast<int>(std::lround(frames_per_second));
  constexpr int most = 99, hours_of_day = 24;
  if (rate < 1 || rate > most) return {};
  const int seconds = frame / rate;
  return fmt::format("{:02}:{:02}:{:02}:{:02}", seconds / 3600 % hours_of_day, seconds / 60 % 60,
                     seconds % 60, frame % rate);
}

}  // namespace

RenderStats FilmDrawer::draw(int frame, const Scene& scene, const Snapshot& snapshot,
                             const std::vector<Moment>& moments, OtherScenes& other_scenes,
                             const std::filesystem::path& output,
                             const std::function<void()>& before_writing) {
  DrawnFrame drawn = drawer_.draw(with_known_tone(frame, scene), snapshot, other_scenes, moments);
  before_writing();
  tell(drawn.notes);
  tell_of_bad_particles(drawn);
  finish();
  if (output.empty()) return drawn.stats;
  std::map<std::string, std::string> metadata = {{"splotchcl:frame", std::to_string(frame)}};
  const std::string code = timecode(frame, scene.movie.frames_per_second);
  if (!code.empty()) metadata["splotchcl:timecode"] = code;
  writing_ = in_background([output, pictures = std::move(drawn.pictures),
                            options = image_file_options(scene, std::move(metadata))] {
    write_pictures(output, pictures, options);
  });
  return drawn.stats;
}

void FilmDrawer::finish() {
  if (writing_.valid()) writing_.get();
}

void FilmDrawer::tell(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) {
    if (told_.insert(note).second && note_) note_(note);
  }
}

void FilmDrawer::tell_of_bad_particles(const DrawnFrame& drawn) {
  if (!drawn.bad_particles || has_told_bad_) return;
  has_told_bad_ = true;
  tell({*drawn.bad_particles});
}

}  // namespace splotchcl
