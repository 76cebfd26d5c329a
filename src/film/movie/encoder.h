#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <vector>

#include "splotchcl/movie.h"

namespace splotchcl {

// Whether the ending names a film: .mp4, .mov, .mkv or .webm.
bool is_film_path(const std::filesystem::path& path);

// Throws UsageError when the codec does not fit the file's ending or the picture has sides
// that films cannot have, DataError when there is no ffmpeg.
void check_film(const std::filesystem::path& path, const MovieSettings& settings, int width,
                int height);

// Makes a film of pictures through a process of ffmpeg. The same pictures give the same
// bytes. The film appears under its name when it is complete.
class Encoder {
 public:
  // `scratch`: a folder on the same file system, for the unfinished film. Throws DataError.
  Encoder(const std::filesystem::path& path, const MovieSettings& settings, int width, int height,
          const std::filesystem::path& scratch);
  ~Encoder();
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  // 8 bits each of red, green and blue, row by row.
  void add(const std::vector<std::uint8_t>& picture);
  void finish();

 private:
  [[noreturn]] void fail();
  bool wait_for_end();  // true: it did its work

  std::filesystem::path path_, unfinished_, log_;
  int input_ = -1;
  pid_t process_ = -1;
};

}  // namespace splotchcl
