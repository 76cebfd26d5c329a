#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>

#include "common/output_files.h"
#include "film/frames/film_drawer.h"
#include "film/frames/film_scene.h"
#include "film/movie/codecs.h"
#include "film/movie/encoder.h"
#include "film/movie/film_layout.h"
#include "film/movie/frame_files.h"
#include "parallel/available_memory.h"
#include "parallel/ordered_tasks.h"
#include "pictures/other_scenes.h"
#include "ranks/exchange.h"
#include "splotchcl/error.h"
#include "splotchcl/film.h"
#include "splotchcl/image_file.h"

namespace splotchcl {
namespace {

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
  if (!files.is_film() && !scene.movie.audio.empty()) {
    throw UsageError("movie.audio: found " + scene.movie.audio +
                     " for numbered images, which have no sound, expected a film such as film.mp4");
  }
  for (const PictureSize& size : sizes_of(scene)) {
    if (files.is_film()) {
      check_film(files.film(size.suffix), scene.movie, size.width, size.height);
    } else {
      check_image_size(files.picture(0, size.suffix), size.width, size.height);
      check_image_bits(files.picture(0, size.suffix), scene.image.bits);
    }
  }
}

// What a PNG file of 8 or 16 bits holds, the lower byte first.
std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path, int bits) {
  const Image image = read_image(path);
  const float largest = bits == 16 ? 65535 : 255;
  std::vector<std::uint8_t> bytes;
  bytes.reserve(image.pixels.size() / 4 * 3 * static_cast<std::size_t>(bits / 8));
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (i % 4 == 3) continue;
    const auto value = static_cast<std::uint32_t>(largest * image.pixels[i] + 0.5F);
    bytes.push_back(static_cast<std::uint8_t>(value & 0xFF));
    if (bits == 16) bytes.push_back(static_cast<std::uint8_t>(value >> 8));
  }
  return bytes;
}

// Between drawing and joining, frames of a film of 10 bits have 16.
int frame_bits(const std::filesystem::path& film, const MovieSettings& movie) {
  return film_bits(film, movie) == 10 ? 16 : 8;
}

// What is followed is looked for among all particles: what needs no scene is refused before.
void check_before_reading(const FilmOptions& options) {
  check_choice(options.frames, options.part);
  if (options.ranks && options.ranks->rank() > 0) return;
  FrameFiles(options.output, {""}).check();
}

// One film that is being made.
class Film {
 public:
  Film(const FilmOptions& options, const FilmReport& report)
      : options_(options),
        report_(report),
        scene_(options.scene, options.settings, options.ranks, options.target),
        start_(scene_.scene_at(0)),
        files_(options.output, suffixes_of(start_)) {
    if (has_files()) check_pictures(files_, start_);
    frames_ = select_frames(options.frames, scene_.path().frame_count());
    part_ = select_part(options.part, frames_);
    if (has_files()) check_files();
  }

  // Collective, where there are several ranks: the first one knows what is to be drawn, and makes
  // the film.
  FilmResult make() {
    bool is_complete = false;
    std::vector<int> frames;
    ContentMarks marks;
    agree(options_.ranks.get(), [&] {
      is_complete = has_files() && options_.only_join && !files_.is_begun();
      if (is_complete) require_complete();
    });
    if (options_.ranks) broadcast_value(*options_.ranks, is_complete);
    if (is_complete) return result(FilmState::complete_before);
    agree(options_.ranks.get(), [&] {
      status("reading");
      scene_.decide();
      scene_.check_files();
      if (!has_files()) return;
      files_.open(
          film_manifest(as_stored(scene_.scene()), scene_.path(), options_.by_reference, marks),
          scene_.path().frame_count());
      if (!options_.only_join) frames = missing(part_);
    });
    if (options_.ranks) {
      require_same_files(*options_.ranks, film_inputs(scene_.scene(), scene_.path()).with_sets(),
                         marks);
      broadcast_values(*options_.ranks, frames);
    }
    draw(frames);
    FilmResult made = result(FilmState::part_is_drawn);
    agree(options_.ranks.get(), [&] {
      if (has_files()) made = complete();
    });
    return made;
  }

 private:
  // Of several ranks the first.
  bool has_files() const { return !options_.ranks || options_.ranks->rank() == 0; }

  // Frames of a film have as many bits as the film needs, images as many as the scene says.
  Scene as_stored(Scene scene) const {
    if (files_.is_film()) scene.image.bits = frame_bits(options_.output, start_.movie);
    return scene;
  }

  void status(const std::string& what) const {
    if (report_.status) report_.status(what);
  }

  // Nothing that is read is written.
  void check_files() const {
    std::vector<OutputFile> outputs;
    for (const std::filesystem::path& path : files_.outputs(frames_))
      outputs.push_back({path, "--output"});
    if (options_.stats) outputs.push_back({*options_.stats, "--stats"});
    if (options_.timeline) outputs.push_back({*options_.timeline, "--timeline"});
    const auto inputs = [this] {
      return film_files_read(options_.scene, scene_.scene(), scene_.path());
    };
    check_outputs(outputs, inputs);
    if (files_.is_film()) check_own_folder(files_.folder(), "--output", inputs);
  }

  // The last part has made the film already, or nobody has begun it.
  void require_complete() const {
    if (files_.is_complete(frames_)) return;
    throw DataError(options_.output.string() +
                    ": found no frames to join, expected those of its parts; draw them first");
  }

  std::vector<int> missing(const std::vector<int>& frames) const {
    std::vector<int> result;
    std::copy_if(frames.begin(), frames.end(), std::back_inserter(result),
                 [this](int frame) { return !files_.has(frame); });
    return result;
  }

  // Frames all along the film decide what is left to pictures, whichever frames are drawn here:
  // parts of a film agree. Where a frame fades to another scene, it may be any.
  void decide_tone(FilmDrawer& drawer) {
    const int count = scene_.path().frame_count();
    const auto decide = [&](int frame) {
      const Scene scene = scene_.scene_at(frame);
      if (!FilmDrawer::asks_for_tone(scene, scene_.other_scenes())) return;
      status("finding the film's exposure");
      drawer.decide_tone(frame, scene, *scene_.snapshot_at(scene), scene_.other_scenes());
    };
    for (const int frame : frames_that_decide(count, start_.finish.exposure_follows))
      decide(frame);
    for (int frame = 0; frame < count; ++frame) {
      if (drawer.lacks_tone(scene_.scene_at(frame), scene_.other_scenes()) &&
          !start_.finish.cross_fade.scene.empty())
        decide(frame);
    }
  }

  void draw(const std::vector<int>& frames) {
    if (has_files()) files_.remove_leftovers(frames);
    if (frames.empty()) return;
    if (!options_.by_reference) status("starting the device");
    FrameDrawerOptions of_drawer;
    of_drawer.device = options_.device;
    of_drawer.by_reference = options_.by_reference;
    of_drawer.columns_stay = true;
    of_drawer.memory_bytes = options_.memory_bytes;
    of_drawer.tree = options_.tree;
    of_drawer.ranks = options_.ranks;
    if (has_files() && !options_.as_displayed)
      of_drawer.light = light_of_file(files_.picture(frames.front(), ""));
    FilmDrawer drawer(of_drawer, {report_.note, report_.span});
    drawer.tell(scene_.notes());
    decide_tone(drawer);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      LoadedFrame loaded = load(drawer, frames[i]);
      // It may have been asked meanwhile.
      if (drawer.begun() > 0) stop_if_asked(drawer);
      tell_frame(drawer, frames[i], i, frames.size());
      drawer.begin(std::move(loaded), scene_.other_scenes());
      end_frames(drawer, drawer.may_go_on() ? 1 : 0);
      agree(options_.ranks.get(), [&] { stop_if_asked(drawer); });
    }
    end_frames(drawer, 0);
    agree(options_.ranks.get(), [&] {
      drawer.finish();
      if (has_files()) require_drawn(frames);
    });
  }

  // While the device draws the frame before. What is wrong with that one is told first.
  LoadedFrame load(FilmDrawer& drawer, int frame) {
    try {
      const Scene scene = as_stored(scene_.scene_at(frame));
      return drawer.load(frame, scene, scene_.snapshot_at(scene), moments_of(frame));
    } catch (const Error&) {
      end_frames(drawer, 0);
      if (!options_.ranks) scene_.check_files();
      throw;
    }
  }

  // All but so many of those that were begun last. What changes while it is drawn may fail
  // anywhere: then that is what to tell.
  void end_frames(FilmDrawer& drawer, std::size_t left) {
    const auto output = [this](int frame) {
      return has_files() ? files_.picture(frame, "") : std::filesystem::path();
    };
    try {
      while (drawer.begun() > left) {
        const auto [frame, stats] =
            drawer.end(output, [&] { agree(options_.ranks.get(), [&] { scene_.check_files(); }); });
        if (report_.drawn) report_.drawn(frame, stats);
      }
    } catch (const Error&) {
      if (!options_.ranks) scene_.check_files();
      throw;
    }
  }

  // Those of the time that the shutter is open; none without motion blur.
  std::vector<Moment> moments_of(int frame) {
    std::vector<Moment> moments;
    for (const Scene& scene : scene_.blurred_scenes(frame))
      moments.push_back({as_stored(scene), [this, scene] { return scene_.snapshot_at(scene); }});
    return moments;
  }

  // Somebody else may tidy up where they lie.
  void require_drawn(const std::vector<int>& frames) const {
    for (const int frame : missing(frames)) {
      throw DataError(files_.picture(frame, "").string() +
                      ": was drawn, but is not there any more, or is another file; draw it again "
                      "and leave it where it is");
    }
  }

  // What this throws ends the film, and frames that were begun are kept.
  void tell_frame(FilmDrawer& drawer, int frame, std::size_t done, std::size_t all) {
    if (!report_.frame) return;
    try {
      report_.frame(frame, done, all);
    } catch (...) {
      end_frames(drawer, 0);
      drawer.finish();
      throw;
    }
  }

  void stop_if_asked(FilmDrawer& drawer) {
    if (!has_files() || !report_.is_stopped || !report_.is_stopped()) return;
    end_frames(drawer, 0);
    drawer.finish();
    throw DataError(
        "stopped; the frames that were drawn are kept, and the same command goes on with the "
        "next");
  }

  // Makes the film where all its frames are there.
  FilmResult complete() {
    const std::size_t lacking = missing(frames_).size();
    if (lacking > 0 && options_.only_join) {
      throw DataError(fmt::format("{}: {} of {} frames are missing; draw the parts that are left",
                                  files_.folder().string(), lacking, frames_.size()));
    }
    if (lacking > 0) return result(FilmState::part_is_drawn);
    scene_.check_files();
    const FrameFiles::Lock lock(files_);
    if (!lock) return result(FilmState::joined_by_another);
    if (files_.is_film()) join();
    if (is_within_interrupted_film()) {
      tell_what_stays();
    } else {
      files_.close(frames_);
    }
    return result(FilmState::complete);
  }

  // Whether a longer film, of which these are some of the frames, still needs what was drawn of it.
  // Numbered images need nothing more where all are there.
  bool is_within_interrupted_film() const {
    const std::vector<int> all = select_frames("", scene_.path().frame_count());
    const std::size_t lacking = missing(all).size();
    const bool has_others = all.size() - lacking > frames_.size();
    return has_others && (files_.is_film() || lacking > 0);
  }

  void tell_what_stays() const {
    if (!report_.note) return;
    report_.note(files_.kept().string() +
                 " stays: other frames of this film are drawn, too, and the command without "
                 "--frames goes on with them; remove it if they are not wanted");
  }

  void join() const {
    status("joining the frames");
    const FilmLayout layout = layout_of(scene_.scene_at(frames_.front()));
    if (report_.note && !can_tell(options_.output, layout)) {
      report_.note(options_.output.string() +
                   ": such films cannot say that they are panoramas, and play flat; .mp4 and .mov "
                   "can");
    }
    for (const PictureSize& size : sizes_of(start_)) {
      files_.remove_unfinished_film(size.suffix);
      Encoder encoder(files_.film(size.suffix), start_.movie, size.width, size.height, layout);
      const int bits = frame_bits(options_.output, start_.movie);
      const std::uint64_t bytes = std::uint64_t{4 * sizeof(float)} *
                                  static_cast<std::uint64_t>(size.width) *
                                  static_cast<std::uint64_t>(size.height);
      const std::size_t most = held_within_memory(bytes);
      OrderedTasks<std::vector<std::uint8_t>> reading;
      std::size_t next = 0;
      for (std::size_t i = 0; i < frames_.size(); ++i) {
        for (; next < frames_.size() && reading.size() < most; ++next) {
          reading.begin([file = files_.picture(frames_[next], size.suffix), bits] {
            return read_bytes(file, bits);
          });
        }
        if (report_.progress) {
          report_.progress("joining the frames",
                           static_cast<double>(i) / static_cast<double>(frames_.size()));
        }
        encoder.add(reading.take());
      }
      encoder.finish();
    }
  }

  FilmResult result(FilmState state) const {
    return {state, frames_.size(), start_.image.width, start_.image.height};
  }

  const FilmOptions& options_;
  const FilmReport& report_;
  FilmScene scene_;
  Scene start_;  // as the first frame shows it, before anything is decided
  FrameFiles files_;
  std::vector<int> frames_, part_;
};

}  // namespace

FilmResult make_film(const FilmOptions& options, const FilmReport& report) {
  std::optional<Film> film;
  agree(options.ranks.get(), [&] {
    check_before_reading(options);
    film.emplace(options, report);
  });
  return film->make();
}

}  // namespace splotchcl
