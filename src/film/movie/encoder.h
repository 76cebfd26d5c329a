#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/unfinished_file.h"
#include "film/movie/film_layout.h"
#include "splotchcl/movie.h"

namespace splotchcl {

// Whether the ending names a film: .mp4, .mov, .mkv or .webm.
bool is_film_path(const std::filesystem::path& path);

// Throws UsageError when the codec does not fit the file's ending or the picture has sides or bits
// that it cannot have, DataError when there is no ffmpeg, or it lacks the encoder, or finds no
// sound where there should be some.
void check_film(const std::filesystem::path& path, const MovieSettings& settings, int width,
                int height);

// Makes a film of pictures through a process of ffmpeg. The same pictures give the same
// bytes. The film appears under its name when it is complete and ffmpeg can read it.
class Encoder {
 public:
  // The film says its layout as far as can_tell().
  // An ffmpeg that gets on with nothing for as long as `patience` is ended. Throws DataError.
  Encoder(const std::filesystem::path& path, const MovieSettings& settings, int width, int height,
          const FilmLayout& layout = {},
          std::chrono::milliseconds patience = std::chrono::minutes(5));
  ~Encoder();
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  // 8 bits each of red, green and blue, row by row.
  void add(const std::vector<std::uint8_t>& picture);
  void finish();

 private:
  struct Process;

  void wait_until_it_reads();
  void check_film_is_whole();
  void end_input();
  [[noreturn]] void end_in_failure();
  [[noreturn]] void fail_stuck(const std::string& what) const;
  [[noreturn]] void fail(const std::string& messages) const;

  std::filesystem::path path_;
  FilmLayout layout_;
  std::chrono::milliseconds patience_;
  UnfinishedFile film_;
  std::unique_ptr<Process> process_;
  int input_ = -1;
  std::uint64_t frames_ = 0;
};

}  // namespace splotchcl
