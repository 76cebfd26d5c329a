#include "film/frames/film_drawer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "finish/effects.h"
#include "finish/tone.h"
#include "parallel/available_memory.h"
#include "pictures/other_scenes.h"
#include "splotchcl/load.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {
namespace {

// In stops.
struct Levels {
  double exposure = 0, white = 0;
};

Levels operator+(const Levels& a, const Levels& b) {
  return {a.exposure + b.exposure, a.white + b.white};
}

Levels operator*(double factor, const Levels& levels) {
  return {factor * levels.exposure, factor * levels.white};
}

Levels levels_of(const FinishSettings& finish) {
  return {finish.exposure.value(), std::log2(finish.white.value())};
}

// The light, as drawn, that becomes white.
double white_light(const FinishSettings& finish) {
  return finish.white.value() * std::exp2(-finish.exposure.value());
}

using Found = std::map<int, FinishSettings>;

// Half of it, and a quarter of each neighbour; the ends are their own.
Levels averaged(const Found& found, Found::const_iterator at) {
  const auto before = at == found.begin() ? at : std::prev(at);
  const auto after = std::next(at) == found.end() ? at : std::next(at);
  return 0.5 * levels_of(at->second) +
         0.25 * (levels_of(before->second) + levels_of(after->second));
}

}  // namespace

void FilmTone::give_to(FinishSettings& finish, int frame) const {
  if (is_empty()) return;
  take_tone(finish.exposure_follows ? following(frame) : of_brightest(), finish);
}

FinishSettings FilmTone::of_brightest() const {
  return std::max_element(found_.begin(), found_.end(),
                          [](const auto& a, const auto& b) {
                            return white_light(a.second) < white_light(b.second);
                          })
      ->second;
}

FinishSettings FilmTone::following(int frame) const {
  auto after = found_.lower_bound(frame);
  if (after == found_.end()) after = std::prev(after);
  const auto before = after == found_.begin() || after->first <= frame ? after : std::prev(after);
  const int span = after->first - before->first;
  const double part = span > 0 ? static_cast<double>(frame - before->first) / span : 0;
  const Levels levels = (1 - part) * averaged(found_, before) + part * averaged(found_, after);
  FinishSettings finish = before->second;
  finish.exposure = levels.exposure;
  finish.white = std::exp2(levels.white);
  return finish;
}

std::vector<int> frames_that_decide(int frames, bool follows) {
  constexpr int most = 32, frames_for_each = 8;
  const int last = frames - 1, fewest = follows ? 16 : 2;
  const int steps = std::clamp(last / frames_for_each, std::min(fewest, last), most);
  std::vector<int> chosen;
  for (int i = 0; i <= steps; ++i)
    chosen.push_back(static_cast<int>(std::int64_t{last} * i / std::max(1, steps)));
  return chosen;
}

FilmDrawer::FilmDrawer(const FrameDrawerOptions& options, Report report)
    : drawer_(options),
      report_(std::move(report)),
      draws_alone_(options.by_reference || options.ranks != nullptr) {}

// Waits for the frames that are being drawn and written.
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
  const std::optional<FinishSettings> found = drawer_.find_finish(scene, snapshot, other_scenes);
  if (!leaves_tone_to_pictures(scene) || !found) return;
  if (!has_open_tone(*found)) tone_.add(frame, *found);
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

std::uint64_t bytes_of(const std::vector<Picture>& pictures) {
  std::uint64_t bytes = 0;
  for (const Picture& picture : pictures)
    bytes += (picture.image.pixels.size() + picture.light.pixels.size()) * sizeof(float);
  return bytes;
}

}  // namespace

LoadedFrame FilmDrawer::load(int frame, Scene scene, std::shared_ptr<const Snapshot> snapshot,
                             std::vector<Moment> moments) const {
  const auto start = std::chrono::steady_clock::now();
  LoadedFrame loaded;
  loaded.frame = load_frame(scene, *snapshot, loaded.notes);
  loaded.number = frame;
  loaded.scene = with_known_tone(frame, std::move(scene));
  loaded.snapshot = std::move(snapshot);
  loaded.moments = std::move(moments);
  loaded.reading = {"load", false, start, std::chrono::steady_clock::now()};
  return loaded;
}

void FilmDrawer::begin(LoadedFrame frame, OtherScenes& other_scenes) {
  // Moments and other scenes are read while they are drawn, and what was read of them is kept.
  const bool reads = !frame.moments.empty() || cross_fade_scene(frame.scene).has_value();
  may_go_on_ = !draws_alone_ && !reads;
  drawing_.begin([this, &other_scenes, frame = std::move(frame)] {
    DrawnFrame drawn = drawer_.draw(frame.scene, frame.frame, frame.snapshot->info(), other_scenes,
                                    frame.notes, frame.moments);
    return Drawn{frame.number, frame.scene, std::move(drawn), frame.reading};
  });
}

std::pair<int, RenderStats> FilmDrawer::end(
    const std::function<std::filesystem::path(int frame)>& output,
    const std::function<void()>& before_writing) {
  Drawn of_frame = drawing_.take();
  before_writing();
  tell(of_frame.drawn.notes);
  tell_of_bad_particles(of_frame.drawn);
  tell_span(of_frame.number, of_frame.reading);
  for (const TimeSpan& span : of_frame.drawn.stats.spans)
    tell_span(of_frame.number, span);
  write(of_frame.number, of_frame.scene, std::move(of_frame.drawn.pictures),
        output(of_frame.number));
  return {of_frame.number, std::move(of_frame.drawn.stats)};
}

void FilmDrawer::write(int frame, const Scene& scene, std::vector<Picture> pictures,
                       const std::filesystem::path& output) {
  // To write one takes several times as long as to draw it on a GPU.
  const std::size_t most = held_within_memory(bytes_of(pictures));
  while (writing_.size() >= most)
    end_writing();
  if (output.empty()) return;
  std::map<std::string, std::string> metadata = {{"splotchcl:frame", std::to_string(frame)}};
  const std::string code = timecode(frame, scene.movie.frames_per_second);
  if (!code.empty()) metadata["splotchcl:timecode"] = code;
  writing_.begin([frame, output, pictures = std::move(pictures),
                  options = image_file_options(scene, std::move(metadata))] {
    const auto start = std::chrono::steady_clock::now();
    write_pictures(output, pictures, options);
    return Written{frame, {"write", false, start, std::chrono::steady_clock::now()}};
  });
}

void FilmDrawer::end_writing() {
  const Written written = writing_.take();
  tell_span(written.frame, written.span);
}

void FilmDrawer::finish() {
  while (writing_.size() > 0)
    end_writing();
}

void FilmDrawer::tell_span(int frame, const TimeSpan& span) const {
  if (report_.span) report_.span(frame, span);
}

void FilmDrawer::tell(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) {
    if (told_.insert(note).second && report_.note) report_.note(note);
  }
}

void FilmDrawer::tell_of_bad_particles(const DrawnFrame& drawn) {
  if (!drawn.bad_particles || has_told_bad_) return;
  has_told_bad_ = true;
  tell({*drawn.bad_particles});
}

}  // namespace splotchcl
