#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "splotchcl/frame_drawer.h"
#include "splotchcl/tree_use.h"

namespace splotchcl {

// What a film that is suggested goes to, or keeps in view: the "densest" place, or a halo,
// "halo=N". Empty: all.
struct FilmTarget {
  std::string name;
  bool is_approached = false;  // from all that the scene shows
};

// A film, as the command `splotchcl movie` makes it (docs/movies.md).
struct FilmOptions {
  // As for open_scene; its [path] and [movie] say what the film is. That of a snapshot or of a
  // sequence, if nothing says, is an orbit, through all its time.
  std::filesystem::path scene;
  std::filesystem::path output;       // a film (.mp4, .mov, .mkv, .webm), or frame_%04d.png
  std::vector<std::string> settings;  // "key=value" strings of scene keys
  FilmTarget target;                  // of a scene whose [path] says nothing
  std::string device;                 // as in FrameDrawerOptions
  bool by_reference = false;
  std::uint64_t memory_bytes = 0;  // as in RendererOptions
  TreeUse tree = TreeUse::automatic;
  std::string frames;  // FIRST:END:STEP; empty: all of the path
  std::string part;    // K/N, the K-th of N runs of frames; empty: all
  // Files that the caller writes in the end, if any: refused where they are read, or are the
  // film's.
  std::optional<std::filesystem::path> stats, timeline;
  bool as_displayed = false;  // numbered files of floats hold what a display shows
  bool only_join = false;     // makes the film of frames that are drawn already
  // As in FrameDrawerOptions: each frame is drawn by all ranks, which all call make_film. The first
  // of them has the files. It alone reports notes and progress; what stops it stops all.
  std::shared_ptr<Communicator> ranks = nullptr;
};

// Who is told while a film is made. Each may be empty.
struct FilmReport {
  std::function<void(const std::string&)> note;    // what the user should know, a line
  std::function<void(const std::string&)> status;  // what is being done
  std::function<void(const std::string& what, double fraction)> progress;
  // Before each frame: its number, and how many were begun before it of those to be drawn. The one
  // before may still be drawn.
  std::function<void(int frame, std::size_t done, std::size_t total)> frame;
  // After each frame that was drawn: its number and what it took.
  std::function<void(int frame, const RenderStats& stats)> drawn;
  // After each frame that was drawn or written, what happened when: "load", those of RenderStats,
  // "finish", "write".
  std::function<void(int frame, const TimeSpan& span)> span;
  // Asked before and after each frame; true ends the film as an interruption does.
  std::function<bool()> is_stopped;
};

// What there is in the end.
enum class FilmState {
  complete,           // the film, or all its numbered images
  complete_before,    // there was nothing to join: it had been made already
  part_is_drawn,      // other parts are missing
  joined_by_another,  // process, which is at it
};

struct FilmResult {
  FilmState state = FilmState::complete;
  std::size_t frames = 0;     // of the film, or of the selection of it
  int width = 0, height = 0;  // of a view of the scene, in pixels
};

// Draws what is missing of the film's frames, and makes the film where all are there. A film that
// was interrupted is continued by the same call. Every frame of the path is checked before the
// first is drawn. Throws UsageError for a scene, a path or an output that is wrong, DataError for
// files that cannot be read or written, a missing ffmpeg, frames that are missing for only_join,
// and where it was stopped, DeviceError.
FilmResult make_film(const FilmOptions& options, const FilmReport& report = {});

}  // namespace splotchcl
