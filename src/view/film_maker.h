#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace splotchcl::view {

// How far the film is that pages have asked for last.
struct FilmProgress {
  enum class State { reading, drawing, joining, complete, cancelled, failed };

  State state = State::reading;
  std::filesystem::path path;
  std::size_t done = 0, frames = 0;    // frames of the film
  std::optional<double> seconds_left;  // known once some are drawn
  std::size_t number = 0;              // by which the film, once complete, is fetched
  std::string text;                    // what went wrong
};

// Makes films beside the pictures of pages, one at a time, in a thread of its own, as splotchcl
// movie makes them. Whoever has asked may go: what is drawn is everybody's.
class FilmMaker {
 public:
  using Tell = std::function<void(const FilmProgress&)>;

  // `tell` is called from the film's thread.
  FilmMaker(std::string device, Tell tell);
  // Ends what is being drawn after its frame.
  ~FilmMaker();
  FilmMaker(const FilmMaker&) = delete;
  FilmMaker& operator=(const FilmMaker&) = delete;

  // Throws UsageError while a film is being drawn.
  void require_idle() const;
  // Draws the film of a scene file. Throws as require_idle does.
  void start(const std::filesystem::path& scene, const std::filesystem::path& film);
  // Nothing is left of it, unless it was begun before by others.
  void cancel() { is_cancelled_ = true; }
  // The frames that are drawn stay, and the same film goes on with them.
  void interrupt() { is_interrupted_ = true; }

  std::optional<FilmProgress> progress() const;
  // A film that was made since the program began. For any thread.
  std::optional<std::filesystem::path> film(std::size_t number) const;

 private:
  void make(const std::filesystem::path& scene, FilmProgress progress);
  void set(const FilmProgress& progress);

  std::string device_;
  Tell tell_;
  std::atomic<bool> is_cancelled_ = false, is_interrupted_ = false;
  mutable std::mutex mutex_;  // guards what follows
  std::optional<FilmProgress> progress_;
  std::map<std::size_t, std::filesystem::path> films_;
  std::thread thread_;
};

}  // namespace splotchcl::view
