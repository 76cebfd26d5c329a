#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands.h"
#include "cli/draw_options.h"
#include "cli/json_answer.h"
#include "cli/processes.h"
#include "common/output_files.h"
#include "common/unfinished_file.h"
#include "common/words.h"
#include "film/dome/dome_test_frame.h"
#include "film/frames/film_scene.h"
#include "film/movie/frame_files.h"
#include "ranks/exchange.h"
#include "splotchcl/error.h"
#include "splotchcl/film.h"
#include "splotchcl/image_file.h"
#include "splotchcl/load.h"
#include "splotchcl/renderer.h"

namespace splotchcl::cli {
namespace {

// A part of the work on one frame of a film.
struct FilmSpan {
  int frame = 0;
  TimeSpan span;
};

using Clock = std::chrono::steady_clock;

double microseconds(Clock::duration duration) {
  return std::chrono::duration<double, std::micro>(duration).count();
}

// Which row each span is shown in. Spans are asked for in the order in which they began.
class Rows {
 public:
  std::string row_of(const FilmSpan& film) {
    const TimeSpan& span = film.span;
    if (span.is_on_device) return "device";
    if (span.what == "load") return "load";
    if (span.what == "write") return "write " + std::to_string(free_writer(span) + 1);
    return "draw " + std::to_string(turn_of(film.frame) + 1);
  }

 private:
  std::size_t free_writer(const TimeSpan& span) {
    const auto found = std::find_if(writers_.begin(), writers_.end(),
                                    [&](Clock::time_point end) { return end <= span.begin; });
    const auto writer = found != writers_.end() ? found : writers_.insert(found, span.end);
    *writer = span.end;
    return static_cast<std::size_t>(writer - writers_.begin());
  }

  // A frame begins to be drawn after the last but one has ended.
  std::size_t turn_of(int frame) {
    constexpr std::size_t turns = 2;
    return turns_.emplace(frame, turns_.size() % turns).first->second;
  }

  std::vector<Clock::time_point> writers_;  // when each is free again
  std::map<int, std::size_t> turns_;
};

Json row_name(std::size_t number, const std::string& name) {
  return {{"name", "thread_name"},
          {"ph", "M"},
          {"pid", 1},
          {"tid", number},
          {"args", {{"name", name}}}};
}

// Events of Chrome's trace format, which Perfetto and chrome://tracing show: the device in one row;
// of the host reading in one, drawing frames by turns in two, writing in as many as write at a
// time. Microseconds from the earliest. The file appears only when complete.
void write_timeline(const std::filesystem::path& path, const std::vector<FilmSpan>& spans) {
  std::vector<FilmSpan> in_order = spans;
  std::stable_sort(in_order.begin(), in_order.end(), [](const FilmSpan& a, const FilmSpan& b) {
    return a.span.begin < b.span.begin;
  });
  Json events = Json::array();
  Rows rows;
  std::map<std::string, std::size_t> numbers;
  for (const FilmSpan& film : in_order) {
    const TimeSpan& span = film.span;
    const std::string row = rows.row_of(film);
    const auto [number, is_new] = numbers.emplace(row, numbers.size() + 1);
    if (is_new) events.push_back(row_name(number->second, row));
    events.push_back({{"name", span.what},
                      {"ph", "X"},
                      {"pid", 1},
                      {"tid", number->second},
                      {"ts", microseconds(span.begin - in_order.front().span.begin)},
                      {"dur", microseconds(span.end - span.begin)},
                      {"args", {{"frame", film.frame}}}});
  }
  const std::string text = json_text({{"displayTimeUnit", "ms"}, {"traceEvents", events}});
  UnfinishedFile file(path);
  file.write(text.data(), text.size());
  file.finish();
}

volatile std::sig_atomic_t is_stopped = 0;

void stop_after_frame(int) {
  is_stopped = 1;
}

// While it lives, the first Ctrl-C only asks for an end after the frame that is being drawn; a
// second one ends the program.
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

// Tells the console, and has the signals while frames are drawn.
class Watch {
 public:
  Watch(Console& console, bool keeps_spans) : console_(console), keeps_spans_(keeps_spans) {}

  FilmReport report() {
    FilmReport report;
    report.note = [this](const std::string& text) { console_.note(text); };
    report.status = [this](const std::string& what) {
      signals_.reset();
      console_.status(what);
    };
    report.progress = [this](const std::string& what, double fraction) {
      console_.progress(what, fraction);
    };
    report.frame = [this](int frame, std::size_t done, std::size_t total) {
      show_frame(frame, done, total);
    };
    report.drawn = [this](int frame, const RenderStats& stats) {
      drawn_.push_back({frame, stats});
    };
    if (keeps_spans_) {
      report.span = [this](int frame, const TimeSpan& span) { spans_.push_back({frame, span}); };
    }
    report.is_stopped = [] { return is_stopped != 0; };
    return report;
  }

  // The frames that were drawn.
  const std::vector<FilmFrameStats>& drawn() const { return drawn_; }
  // What was done of them, and when.
  const std::vector<FilmSpan>& spans() const { return spans_; }

 private:
  void show_frame(int frame, std::size_t done, std::size_t total) {
    std::string left;
    if (done == 0) {
      signals_.emplace();
      drawing_ = Stopwatch();
    } else {
      const double per_frame = drawing_.seconds() / static_cast<double>(done);
      left = ", " + duration(per_frame * static_cast<double>(total - done)) + " left";
    }
    console_.status(fmt::format("{} frame {}, {} of {}{}", progress_bar(done, total), frame,
                                done + 1, total, left));
  }

  Console& console_;
  const bool keeps_spans_;
  std::optional<StopSignals> signals_;
  Stopwatch drawing_;
  std::vector<FilmFrameStats> drawn_;
  std::vector<FilmSpan> spans_;
};

// A master of planetariums, but for what the user says.
void add_dome(int size, std::vector<std::string>& settings) {
  const std::vector<std::string> own = settings;
  const auto add = [&](const std::string& key, const std::string& value) {
    const bool is_given = std::any_of(own.begin(), own.end(), [&key](const std::string& s) {
      return s.rfind(key + "=", 0) == 0;
    });
    if (!is_given) settings.push_back(key + "=" + value);
  };
  add("image.size", fmt::format("{}x{}", size, size));
  add("camera.projection", "fisheye");
  add("camera.field_of_view", "180");
  add("camera.dome_tilt", "15");
  add("movie.frames_per_second", "30");
}

std::vector<std::string> film_settings(const MovieOptions& options) {
  std::vector<std::string> settings = settings_of(options);
  if (options.audio) settings.push_back("movie.audio=" + *options.audio);
  if (options.dome) add_dome(*options.dome, settings);
  return settings;
}

FilmTarget target_of(const MovieOptions& options) {
  if (!options.dive.empty()) return {options.dive, true};
  return {options.follow, false};
}

// Only what the scene says of its first picture counts: no particles are drawn.
int draw_test_frame(const MovieOptions& options, Console& console) {
  check_image_path(*options.output);
  const FilmScene film(options.scene, film_settings(options), nullptr, target_of(options));
  check_outputs({{*options.output, "--output"}},
                [&] { return film_files_read(options.scene, film.scene(), film.path()); });
  const Scene scene = film.scene_at(0);
  if (scene.camera->projection != Projection::fisheye) {
    throw UsageError(
        "--test-frame: found a scene that is no dome's, expected --dome SIZE, or "
        "camera.projection = \"fisheye\"");
  }
  const auto [width, height] = std::pair(scene.image.width, scene.image.height);
  check_image_size(*options.output, width, height);
  write_image(*options.output, draw_dome_test_frame(*scene.camera, width, height),
              image_file_options(scene));
  console.done(fmt::format("{}: the test frame of a dome, {}x{} pixels", options.output->string(),
                           width, height));
  return 0;
}

FilmOptions film_options(const MovieOptions& options, const std::shared_ptr<Communicator>& ranks) {
  FilmOptions film;
  film.ranks = ranks;
  film.scene = options.scene;
  film.stats = options.stats;
  film.timeline = options.timeline;
  film.output = *options.output;
  film.settings = film_settings(options);
  film.target = target_of(options);
  film.device = options.device;
  film.by_reference = options.reference;
  film.memory_bytes = options.memory_bytes;
  film.tree = options.tree;
  film.frames = options.frames;
  film.part = options.part;
  film.as_displayed = options.display;
  film.only_join = options.join;
  return film;
}

// By the first of the frames that are asked for.
void explain_film(const MovieOptions& options, Console& console) {
  FilmScene film(options.scene, film_settings(options), nullptr, target_of(options));
  const std::vector<int> frames =
      select_part(options.part, select_frames(options.frames, film.path().frame_count()));
  if (frames.empty()) throw UsageError("--part: has no frames to explain");
  console.status("reading");
  film.decide();
  const Scene scene = film.scene_at(frames.front());
  std::vector<std::string> notes = film.notes();
  const Frame frame = load_frame(scene, *film.snapshot_at(scene), notes);
  if (!options.output) console.note_each_once(notes);  // else the film tells them
  const int count = static_cast<int>(frames.size());
  std::cout << fmt::format("# film: {}; what follows is of frame {}\n",
                           counted(frames.size(), "frame"), frames.front());
  const int samples = scene.movie.motion_blur ? scene.movie.motion_blur->samples : 1;
  if (samples > 1) std::cout << fmt::format("# motion blur: {} drawings for each frame\n", samples);
  print_explanation(make_plan(frame), frame, film.scene(), options, count * samples);
}

void tell_result(const FilmResult& result, const MovieOptions& options, Console& console) {
  switch (result.state) {
    case FilmState::complete:
      console.done(fmt::format("{}: {} frames of {}x{} pixels", options.output->string(),
                               result.frames, result.width, result.height));
      break;
    case FilmState::complete_before:
      console.done(options.output->string() + " is complete already");
      break;
    case FilmState::part_is_drawn:
      console.done(
          fmt::format("part {} is drawn; the last part, or splotchcl movie --join, makes the film",
                      options.part));
      break;
    case FilmState::joined_by_another:
      break;
  }
}

}  // namespace

int run_movie(const MovieOptions& options, Console& console) {
  refuse_beside_reference(options, {});
  if (!options.output && !options.explain) {
    throw UsageError(
        "movie: found no --output, expected a film such as film.mp4, or numbered images such as "
        "frame_%04d.png; see splotchcl movie --help");
  }
  if (!options.output) {
    refuse_without_output({{"--stats", options.stats.has_value()},
                           {"--timeline", options.timeline.has_value()},
                           {"--join", options.join},
                           {"--part", !options.part.empty()}});
  }
  if (options.test_frame) {
    if (!options.output) throw UsageError("--test-frame: found no --output, expected a picture");
    return draw_test_frame(options, console);
  }
  const std::shared_ptr<Communicator> ranks = join_processes(console);
  const bool writes = writes_files(ranks);
  agree(ranks.get(), [&] {
    if (options.reference) expect_one_process(ranks.get(), "--reference");
    if (writes && options.stats) check_output_path(*options.stats);
    if (writes && options.timeline) check_output_path(*options.timeline);
    if (writes && options.explain) explain_film(options, console);
  });
  if (!options.output) return 0;
  Watch watch(console, options.timeline.has_value());
  const FilmResult result = make_film(film_options(options, ranks), watch.report());
  if (writes && options.stats) {
    FilmStats stats;
    stats.scene = options.scene.string();
    stats.output = options.output->string();
    stats.reference = options.reference;
    stats.result = result;
    stats.frames = watch.drawn();
    write_stats(*options.stats, stats);
  }
  if (writes && options.timeline) write_timeline(*options.timeline, watch.spans());
  tell_result(result, options, console);
  return 0;
}

}  // namespace splotchcl::cli
