#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace splotchcl {

// The frames that "FIRST:END:STEP" names among those of a film: FIRST, FIRST + STEP, ... before
// END. Each of the three may be left out ("100:", ":200", "::10"); a single number is one
// frame; nothing is all frames. Throws UsageError.
std::vector<int> select_frames(const std::string& text, int frame_count);

// The share of part K of N, given as "K/N", K from 1: neighbouring frames, all parts together
// being all of them. Nothing is all. Throws UsageError.
std::vector<int> select_part(const std::string& text, const std::vector<int>& frames);

// Throws UsageError where these say no such thing, whatever the film.
void check_choice(const std::string& frames, const std::string& part);

// Files whose names differ by a number, which a pattern such as turn_%04d.png has a place for:
// exactly one %d, or with a width as printf knows it, %4d or %04d, in the file's name.
class NumberedFiles {
 public:
  // Nothing for a name that is no such pattern.
  static std::optional<NumberedFiles> find(const std::filesystem::path& pattern);
  // Throws UsageError, naming the option, for such a name.
  static NumberedFiles require(const std::filesystem::path& pattern, const std::string& option);

  std::filesystem::path at(int number) const;

 private:
  explicit NumberedFiles(std::filesystem::path pattern) : pattern_(std::move(pattern)) {}

  std::filesystem::path pattern_;
};

// The files of a film's frames: in a folder beside the film until it is complete, or the
// numbered images that the user asked for. A manifest, which says all that the frames depend
// on, lies beside them, so that a film that was interrupted is continued and frames of
// different films never meet. It also tells which pictures lay there before.
class FrameFiles {
 public:
  // `output` is a film or, with something like %04d in its name, numbered images. `suffixes`
  // are those of a frame's pictures. Throws UsageError when the name is neither.
  FrameFiles(const std::filesystem::path& output, std::vector<std::string> suffixes);

  bool is_film() const { return is_film_; }
  // What is written in the end, by suffix.
  std::filesystem::path film(const std::string& suffix) const;
  std::filesystem::path picture(int frame, const std::string& suffix) const;
  const std::filesystem::path& folder() const { return folder_; }
  // What lies beside the output until close(): the folder of a film's frames, or the manifest.
  const std::filesystem::path& kept() const { return is_film_ ? folder_ : manifest_; }

  // All that is written and stays for a time, but for the frames of a film.
  std::vector<std::filesystem::path> outputs(const std::vector<int>& frames) const;
  // Throws DataError where nothing can be written.
  void check() const;
  // Whether there are frames of a film that is not complete.
  bool is_begun() const;
  // Whether all that is written in the end is there.
  bool is_complete(const std::vector<int>& frames) const;
  // Begins a film, or goes on with one of the same manifest. Throws UsageError where there are
  // frames of another. Pictures of its `frames` frames that are there when it begins are not its
  // own.
  void open(const std::string& manifest, int frames);
  bool has(int frame) const;
  // Removes what is left of these frames where a process was killed while it wrote them.
  void remove_leftovers(const std::vector<int>& frames) const;
  // Removes what is left of a film where a process was killed while it made it.
  void remove_unfinished_film(const std::string& suffix) const;
  // The frames are where they belong: removes the manifest, what killed processes left of these
  // frames, and, of a film, all frames and their folder.
  void close(const std::vector<int>& frames);

  // Only one process at a time holds it; false: another one does, or has ended the film.
  class Lock {
   public:
    explicit Lock(const FrameFiles& files);
    ~Lock();
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;
    explicit operator bool() const { return descriptor_ >= 0; }

   private:
    int descriptor_ = -1;
  };

 private:
  // Throws UsageError where the one that is there is another.
  void check_manifest(const std::string& manifest);
  std::string describe_pictures(int frames) const;
  bool is_own(int frame, const std::string& suffix) const;
  void remove_frames() const;

  std::filesystem::path output_, folder_, manifest_;
  std::optional<NumberedFiles> images_;  // none for a film
  std::vector<std::string> suffixes_;
  bool is_film_;
  int frame_count_ = 0;
  std::set<std::string> older_;  // lines of pictures that were there before the film was begun
};

}  // namespace splotchcl
