#include "film/movie/encoder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <system_error>

#include "common/text_file.h"
#include "common/words.h"
#include "splotchcl/error.h"

extern char** environ;

namespace splotchcl {
namespace {

// ffmpeg's name of the container, by a file's ending.
const std::map<std::string, std::string> containers = {
    {".mp4", "mp4"}, {".mov", "mov"}, {".mkv", "matroska"}, {".webm", "webm"}};

Codec codec_of(const std::filesystem::path& path, const MovieSettings& settings) {
  return settings.codec.value_or(lower_ending(path) == ".webm" ? Codec::vp9 : Codec::h264);
}

bool has_ffmpeg() {
  const char* folders = std::getenv("PATH");
  std::istringstream list(folders == nullptr ? "" : folders);
  for (std::string folder; std::getline(list, folder, ':');) {
    const std::filesystem::path program = std::filesystem::path(folder) / "ffmpeg";
    if (::access(program.c_str(), X_OK) == 0) return true;
  }
  return false;
}

// The number of threads is part of what an encoder's bytes depend on.
std::vector<std::string> codec_arguments(Codec codec, int rate_factor) {
  const std::string quality = std::to_string(rate_factor);
  switch (codec) {
    case Codec::h264:
      return {"-c:v", "libx264", "-crf", quality, "-threads", "4"};
    case Codec::h265:
      return {"-c:v",   "libx265", "-crf",         quality,
              "-tag:v", "hvc1",    "-x265-params", "log-level=error:pools=4:frame-threads=2"};
    case Codec::vp9:
      return {"-c:v", "libvpx-vp9", "-crf", quality, "-b:v", "0", "-threads", "4"};
  }
  return {};
}

std::vector<std::string> arguments(const std::filesystem::path& path, const MovieSettings& settings,
                                   int width, int height, const std::filesystem::path& unfinished) {
  std::vector<std::string> all = {
      "ffmpeg", "-nostdin", "-hide_banner", "-loglevel", "error", "-f", "rawvideo", "-pixel_format",
      "rgb24", "-video_size", fmt::format("{}x{}", width, height), "-framerate",
      fmt::format("{}", settings.frames_per_second), "-i", "pipe:0", "-an",
      // The colours of high-definition television, and said to be those: without, players
      // guess from the picture's size.
      "-vf",
      "scale=in_range=full:out_range=limited:out_color_matrix=bt709:"
      "flags=bicubic+accurate_rnd+full_chroma_int+bitexact,format=yuv420p",
      "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709", "-color_range",
      "tv"};
  const std::vector<std::string> codec =
      codec_arguments(codec_of(path, settings), settings.rate_factor);
  all.insert(all.end(), codec.begin(), codec.end());
  // No times and versions in the file.
  for (const char* const word : {"-flags:v", "+bitexact", "-fflags", "+bitexact", "-map_metadata",
                                 "-1", "-movflags", "+faststart", "-f"}) {
    all.emplace_back(word);
  }
  all.push_back(containers.at(lower_ending(path)));
  all.emplace_back("-y");
  all.push_back(unfinished.string());
  return all;
}

std::string reason(int error_number) {
  return std::generic_category().message(error_number);
}

// The program's standard input is `input`, what it says goes to `log`.
pid_t start(const std::vector<std::string>& words, int input, const std::filesystem::path& log) {
  std::vector<char*> arguments;
  for (const std::string& word : words)
    arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                   0666);
  // In a group of its own, Ctrl-C reaches this program alone, which then decides.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t process = -1;
  const int error =
      ::posix_spawnp(&process, "ffmpeg", &files, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) throw DataError("ffmpeg cannot be started: " + reason(error));
  return process;
}

}  // namespace

bool is_film_path(const std::filesystem::path& path) {
  return containers.count(lower_ending(path)) > 0;
}

void check_film(const std::filesystem::path& path, const MovieSettings& settings, int width,
                int height) {
  if (lower_ending(path) == ".webm" && codec_of(path, settings) != Codec::vp9) {
    throw UsageError(path.string() +
                     ": .webm holds VP9 only; leave out movie.codec, or choose .mp4 or .mkv");
  }
  if (width % 2 != 0 || height % 2 != 0) {
    throw UsageError(fmt::format(
        "{}: found pictures of {}x{} pixels, expected even numbers, as films need; change "
        "image.size, or write numbered images such as frame_%04d.png",
        path.string(), width, height));
  }
  if (!has_ffmpeg()) {
    throw DataError(path.string() +
                    ": films are made by ffmpeg, which is not installed (on Debian: apt-get "
                    "install ffmpeg); numbered images such as -o frame_%04d.png need none");
  }
}

Encoder::Encoder(const std::filesystem::path& path, const MovieSettings& settings, int width,
                 int height, const std::filesystem::path& scratch)
    : path_(path) {
  const std::string unique = std::to_string(::getpid()) + "." + path.filename().string();
  unfinished_ = scratch / ("unfinished." + unique);
  log_ = scratch / ("messages." + unique + ".txt");
  // A socket rather than a pipe: one whose other end is gone answers with an error, not with
  // a signal.
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    throw DataError("no connection to ffmpeg: " + reason(errno));
  }
  input_ = ends[0];
  try {
    process_ = start(arguments(path, settings, width, height, unfinished_), ends[1], log_);
  } catch (...) {
    ::close(ends[0]);
    ::close(ends[1]);
    throw;
  }
  ::close(ends[1]);
}

Encoder::~Encoder() {
  wait_for_end();
  std::error_code ignored;
  std::filesystem::remove(unfinished_, ignored);
  std::filesystem::remove(log_, ignored);
}

void Encoder::add(const std::vector<std::uint8_t>& picture) {
  const std::uint8_t* next = picture.data();
  std::size_t left = picture.size();
  while (left > 0) {
    const ssize_t sent = ::send(input_, next, left, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) fail();
    next += sent;
    left -= static_cast<std::size_t>(sent);
  }
}

void Encoder::finish() {
  if (!wait_for_end()) fail();
  std::error_code error;
  std::filesystem::rename(unfinished_, path_, error);
  if (error) throw DataError(path_.string() + ": cannot be written: " + error.message());
}

bool Encoder::wait_for_end() {
  if (input_ >= 0) ::close(input_);
  input_ = -1;
  if (process_ < 0) return false;
  int status = -1;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void Encoder::fail() {
  wait_for_end();
  std::string said;
  try {
    said = read_text_file(log_);
  } catch (const Error&) {
    // It said nothing.
  }
  while (!said.empty() && said.back() == '\n')
    said.pop_back();
  std::replace(said.begin(), said.end(), '\n', ' ');
  throw DataError(path_.string() + ": ffmpeg could not make the film: " +
                  (said.empty() ? "it ended without a word" : said));
}

}  // namespace splotchcl
