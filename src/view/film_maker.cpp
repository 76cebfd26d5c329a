#include "view/film_maker.h"

#include <chrono>
#include <exception>
#include <system_error>
#include <utility>

#include "splotchcl/error.h"
#include "splotchcl/film.h"
#include "view/answers.h"

namespace splotchcl::view {
namespace {

namespace fs = std::filesystem;
using State = FilmProgress::State;

// Where frames lie until a film is complete (docs/movies.md).
fs::path frames_of(const fs::path& film) {
  return film.string() + ".frames";
}

// Pages need no more.
constexpr double seconds_between_reports = 0.4;

bool is_under_way(const std::optional<FilmProgress>& progress) {
  return progress && (progress->state == State::reading || progress->state == State::drawing ||
                      progress->state == State::joining);
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

FilmMaker::FilmMaker(std::string device, Tell tell)
    : device_(std::move(device)), tell_(std::move(tell)) {}

FilmMaker::~FilmMaker() {
  interrupt();
  if (thread_.joinable()) thread_.join();
}

void FilmMaker::require_idle() const {
  const std::lock_guard lock(mutex_);
  if (!is_under_way(progress_)) return;
  throw UsageError("found another film that is being drawn, " + progress_->path.string() +
                   ", expected none; wait for it, or cancel it");
}

void FilmMaker::start(const fs::path& scene, const fs::path& film) {
  require_idle();
  FilmProgress begun;
  begun.path = film;
  {
    const std::lock_guard lock(mutex_);
    begun.number = progress_ ? progress_->number + 1 : 1;
    progress_ = begun;
  }
  if (thread_.joinable()) thread_.join();
  is_cancelled_ = false;
  thread_ = std::thread([this, scene, begun] { make(scene, begun); });
}

void FilmMaker::make(const fs::path& scene, FilmProgress progress) {
  std::error_code ignored;
  const bool was_begun = fs::exists(frames_of(progress.path), ignored);
  FilmOptions options;
  options.scene = scene;
  options.output = progress.path;
  options.device = device_;
  std::optional<std::chrono::steady_clock::time_point> first_frame;
  FilmReport report;
  std::chrono::steady_clock::time_point last_told;
  report.status = [&](const std::string& what) {
    if (what == "joining the frames") progress.state = State::joining;
    set(progress);
  };
  report.frame = [&](int, std::size_t done, std::size_t total) {
    if (!first_frame) first_frame = std::chrono::steady_clock::now();
    progress.state = State::drawing;
    progress.done = done;
    progress.frames = total;
    if (done > 0) {
      progress.seconds_left = seconds_since(*first_frame) / static_cast<double>(done) *
                              static_cast<double>(total - done);
    }
    if (done > 0 && seconds_since(last_told) < seconds_between_reports) return;
    last_told = std::chrono::steady_clock::now();
    set(progress);
  };
  report.is_stopped = [this] { return is_cancelled_ || is_interrupted_; };
  try {
    set(progress);
    progress.frames = make_film(options, report).frames;
    progress.done = progress.frames;
    progress.state = State::complete;
  } catch (const std::exception& error) {
    progress.state = is_cancelled_ ? State::cancelled : State::failed;
    progress.text = text_for_page(error);
    if (is_cancelled_ && !was_begun) fs::remove_all(frames_of(progress.path), ignored);
  }
  set(progress);
}

void FilmMaker::set(const FilmProgress& progress) {
  {
    const std::lock_guard lock(mutex_);
    progress_ = progress;
    if (progress.state == State::complete) films_[progress.number] = progress.path;
  }
  tell_(progress);
}

std::optional<FilmProgress> FilmMaker::progress() const {
  const std::lock_guard lock(mutex_);
  return progress_;
}

std::optional<fs::path> FilmMaker::film(std::size_t number) const {
  const std::lock_guard lock(mutex_);
  const auto found = films_.find(number);
  if (found == films_.end()) return std::nullopt;
  return found->second;
}

}  // namespace splotchcl::view
