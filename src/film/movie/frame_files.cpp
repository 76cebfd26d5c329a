#include "film/movie/frame_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/printf.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <sstream>
#include <system_error>
#include <utility>

#include "common/file_identity.h"
#include "common/mapped_file.h"
#include "common/unfinished_file.h"
#include "common/words.h"
#include "film/movie/encoder.h"
#include "splotchcl/error.h"
#include "splotchcl/image_file.h"
#include "splotchcl/picture.h"

namespace splotchcl {
namespace {

std::optional<int> read_whole_number(const std::string& text) {
  int value = 0;
  const char* const end = text.data() + text.size();
  const auto [next, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || next != end || value < 0) return std::nullopt;
  return value;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

[[noreturn]] void refuse_range(const std::string& text) {
  throw UsageError(
      fmt::format("--frames: found '{}', expected FIRST:END:STEP, whole numbers such as 100:200:2 "
                  "for 100, 102, ... 198",
                  text));
}

int part_of_range(const std::string& text, const std::string& part, int absent) {
  if (part.empty()) return absent;
  const std::optional<int> number = read_whole_number(part);
  if (!number) refuse_range(text);
  return *number;
}

struct FrameRange {
  int first, end, step;
};

FrameRange range_of(const std::string& text, int frame_count) {
  const std::vector<std::string> parts = split(text.empty() ? ":" : text, ':');
  if (parts.size() > 3 || (parts.size() == 1 && parts[0].empty())) refuse_range(text);
  FrameRange range{};
  range.first = part_of_range(text, parts[0], 0);
  range.end = parts.size() == 1 ? range.first + 1 : part_of_range(text, parts[1], frame_count);
  range.step = parts.size() < 3 ? 1 : part_of_range(text, parts[2], 1);
  if (range.step == 0) refuse_range(text);
  return range;
}

}  // namespace

void check_choice(const std::string& frames, const std::string& part) {
  range_of(frames, 0);
  select_part(part, {});
}

std::vector<int> select_frames(const std::string& text, int frame_count) {
  const auto [first, end, step] = range_of(text, frame_count);
  if (first >= end || end > frame_count) {
    throw UsageError(
        fmt::format("--frames: found {}, expected frames from 0 to {}, of which the "
                    "film has {}, and the first before the end",
                    text, frame_count - 1, frame_count));
  }
  std::vector<int> frames;
  for (std::int64_t frame = first; frame < end; frame += step)
    frames.push_back(static_cast<int>(frame));
  return frames;
}

std::vector<int> select_part(const std::string& text, const std::vector<int>& frames) {
  if (text.empty()) return frames;
  const std::vector<std::string> parts = split(text, '/');
  const auto part = read_whole_number(parts[0]);
  const auto count = parts.size() == 2 ? read_whole_number(parts[1]) : std::nullopt;
  if (!part || !count || *part < 1 || *part > *count) {
    throw UsageError(
        fmt::format("--part: found '{}', expected K/N with K from 1 to N, such as 3/8", text));
  }
  const auto boundary = [&](int parts_before) {
    return static_cast<std::ptrdiff_t>(static_cast<std::uint64_t>(frames.size()) *
                                       static_cast<std::uint64_t>(parts_before) /
                                       static_cast<std::uint64_t>(*count));
  };
  return {frames.begin() + boundary(*part - 1), frames.begin() + boundary(*part)};
}

namespace {

// Whether a number stands at the place of the '%'.
bool is_number(const std::string& name, std::size_t percent) {
  constexpr std::size_t most_digits = 3;
  std::size_t end = percent + 1;
  while (end < name.size() && end - percent <= most_digits &&
         std::isdigit(static_cast<unsigned char>(name[end])) != 0) {
    ++end;
  }
  return end < name.size() && name[end] == 'd';
}

}  // namespace

std::optional<NumberedFiles> NumberedFiles::find(const std::filesystem::path& pattern) {
  const std::string name = pattern.filename().string();
  const bool has_one = std::count(name.begin(), name.end(), '%') == 1;
  if (!has_one || !is_number(name, name.find('%'))) return std::nullopt;
  return NumberedFiles(pattern);
}

NumberedFiles NumberedFiles::require(const std::filesystem::path& pattern,
                                     const std::string& option) {
  if (std::optional<NumberedFiles> files = find(pattern)) return *files;
  throw UsageError(option + ": found '" + pattern.string() +
                   "', expected a name with one place for a number, such as turn_%04d" +
                   pattern.extension().string());
}

std::filesystem::path NumberedFiles::at(int number) const {
  return pattern_.parent_path() / fmt::sprintf(pattern_.filename().string(), number);
}

namespace {

// Whether the open file still has this name.
bool is_file_at(const std::filesystem::path& path, int descriptor) {
  struct stat open = {}, named = {};
  return ::fstat(descriptor, &open) == 0 && ::stat(path.c_str(), &named) == 0 &&
         open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

NumberedFiles numbered_images(const std::filesystem::path& output) {
  if (std::optional<NumberedFiles> images = NumberedFiles::find(output)) return *images;
  throw UsageError(output.string() +
                   ": found no film or numbered images, expected a film (.mp4, .mov, .mkv, .webm) "
                   "or a name with one number in it, such as frame_%04d.png");
}

// The first line in which two texts differ, for a message.
std::string difference(const std::string& found, const std::string& expected) {
  std::istringstream a(found), b(expected);
  std::string line_a, line_b;
  for (;;) {
    const bool has_a = static_cast<bool>(std::getline(a, line_a));
    const bool has_b = static_cast<bool>(std::getline(b, line_b));
    if (!has_a) line_a = "nothing";
    if (!has_b) line_b = "nothing";
    if (line_a != line_b || (!has_a && !has_b)) break;
  }
  return fmt::format("made with '{}' where this film has '{}'", line_a, line_b);
}

// Ends the manifest, before the pictures that were there.
constexpr char older_pictures[] = "older pictures:\n";

// Of a picture that is there. Devices have other numbers on other machines.
std::optional<std::string> line_of(const std::filesystem::path& path, int frame,
                                   const std::string& suffix) {
  const std::optional<FileIdentity> file = file_identity(path);
  if (!file) return std::nullopt;
  return fmt::format("{}{}: {}, file {}", frame, suffix, describe(file), file->node);
}

}  // namespace

FrameFiles::FrameFiles(const std::filesystem::path& output, std::vector<std::string> suffixes)
    : output_(output), suffixes_(std::move(suffixes)), is_film_(is_film_path(output)) {
  if (is_film_) {
    folder_ = output.string() + ".frames";
    manifest_ = folder_ / "movie.txt";
    return;
  }
  images_ = numbered_images(output);
  folder_ = output.has_parent_path() ? output.parent_path() : ".";
  manifest_ = output.string() + ".movie.txt";
}

std::filesystem::path FrameFiles::film(const std::string& suffix) const {
  return picture_path(output_, suffix);
}

std::filesystem::path FrameFiles::picture(int frame, const std::string& suffix) const {
  if (is_film_) return folder_ / fmt::format("frame_{:06d}{}.png", frame, suffix);
  return picture_path(images_->at(frame), suffix);
}

void FrameFiles::check() const {
  for (const std::string& suffix : suffixes_) {
    if (is_film_) {
      check_output_path(film(suffix));
    } else {
      check_image_path(picture(0, suffix));
    }
  }
}

std::vector<std::filesystem::path> FrameFiles::outputs(const std::vector<int>& frames) const {
  std::vector<std::filesystem::path> all = {manifest_};
  for (const std::string& suffix : suffixes_) {
    if (is_film_) {
      all.push_back(film(suffix));
    } else {
      for (const int frame : frames)
        all.push_back(picture(frame, suffix));
    }
  }
  return all;
}

bool FrameFiles::is_begun() const {
  std::error_code error;
  return std::filesystem::exists(manifest_, error);
}

bool FrameFiles::is_complete(const std::vector<int>& frames) const {
  const auto exists = [](const std::filesystem::path& path) {
    std::error_code error;
    return std::filesystem::is_regular_file(path, error);
  };
  return !is_begun() &&
         std::all_of(suffixes_.begin(), suffixes_.end(), [&](const std::string& suffix) {
           if (is_film_) return exists(film(suffix));
           return std::all_of(frames.begin(), frames.end(),
                              [&](int frame) { return exists(picture(frame, suffix)); });
         });
}

void FrameFiles::check_manifest(const std::string& manifest) {
  std::string found = read_text_file(manifest_);
  const std::size_t end = found.rfind(older_pictures);
  if (end != std::string::npos) {
    std::istringstream lines(found.substr(end + sizeof older_pictures - 1));
    for (std::string line; std::getline(lines, line);)
      older_.insert(line);
    found.resize(end);
  }
  if (found == manifest) return;
  throw UsageError(fmt::format(
      "{}: found frames of another film, {}; remove {} to draw all of them anew, or choose "
      "another output",
      manifest_.string(), difference(found, manifest), is_film_ ? "the folder" : "this file"));
}

std::string FrameFiles::describe_pictures(int frames) const {
  std::string text;
  for (int frame = 0; frame < frames; ++frame) {
    for (const std::string& suffix : suffixes_) {
      if (const auto line = line_of(picture(frame, suffix), frame, suffix)) text += *line + "\n";
    }
  }
  return text;
}

void FrameFiles::open(const std::string& manifest, int frames) {
  frame_count_ = frames;
  if (!is_begun()) {
    std::error_code error;
    if (is_film_ && !std::filesystem::create_directories(folder_, error) && error) {
      throw DataError(folder_.string() + ": cannot be created: " + error.message());
    }
    UnfinishedFile file(manifest_);
    const std::string text = manifest + older_pictures + describe_pictures(frames);
    file.write(text.data(), text.size());
    (void)file.finish_unless_there();  // another part may have begun at the same time
  }
  check_manifest(manifest);
}

bool FrameFiles::is_own(int frame, const std::string& suffix) const {
  const auto line = line_of(picture(frame, suffix), frame, suffix);
  return line && older_.count(*line) == 0;
}

bool FrameFiles::has(int frame) const {
  return std::all_of(suffixes_.begin(), suffixes_.end(),
                     [&](const std::string& suffix) { return is_own(frame, suffix); });
}

void FrameFiles::remove_leftovers(const std::vector<int>& frames) const {
  std::set<std::string> names;
  for (const int frame : frames) {
    for (const std::string& suffix : suffixes_) {
      const std::filesystem::path path = picture(frame, suffix);
      names.insert(path.filename().string());
      // In a film's folder nobody means what a link leads to, which would be written into.
      std::error_code error;
      if (is_film_ && std::filesystem::is_symlink(path, error)) {
        std::filesystem::remove(path, error);
      }
    }
  }
  splotchcl::remove_leftovers(folder_, names);
}

void FrameFiles::remove_unfinished_film(const std::string& suffix) const {
  const std::filesystem::path path = film(suffix);
  splotchcl::remove_leftovers(folder_of(path), {path.filename().string()});
}

void FrameFiles::close(const std::vector<int>& frames) {
  remove_leftovers(frames);
  splotchcl::remove_leftovers(folder_of(manifest_), {manifest_.filename().string()});
  std::error_code ignored;
  if (is_film_) remove_frames();
  std::filesystem::remove(manifest_, ignored);
  if (is_film_) std::filesystem::remove(folder_, ignored);  // unless something else lies in it
}

// Only what is a film's own goes: the folder may have been there before.
void FrameFiles::remove_frames() const {
  std::set<std::string> names;
  std::error_code ignored;
  for (int frame = 0; frame < frame_count_; ++frame) {
    for (const std::string& suffix : suffixes_) {
      const std::filesystem::path path = picture(frame, suffix);
      names.insert(path.filename().string());
      if (is_own(frame, suffix)) std::filesystem::remove(path, ignored);
    }
  }
  splotchcl::remove_leftovers(folder_, names);
}

FrameFiles::Lock::Lock(const FrameFiles& files) {
  const std::string name = files.manifest_.string();
  const int descriptor = ::open(name.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0 && errno != ENOENT) {
    throw DataError(name + ": cannot be opened: " + reason(errno));
  }
  if (descriptor < 0) return;
  const int error = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
  // Who held it before may have ended the film, and removed the file that was opened here.
  if (error == 0 && is_file_at(files.manifest_, descriptor)) {
    descriptor_ = descriptor;
    return;
  }
  ::close(descriptor);
  if (error != 0 && error != EWOULDBLOCK) {
    throw DataError(name + ": cannot be locked: " + reason(error) +
                    "; make the film on another file system");
  }
}

FrameFiles::Lock::~Lock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace splotchcl
