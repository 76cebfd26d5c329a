#include "film/movie/encoder.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <string>

#include "common/child_process.h"
#include "common/reason.h"
#include "common/words.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// ffmpeg's name of the container, by a file's ending.
const std::map<std::string, std::string> containers = {
    {".mp4", "mp4"}, {".mov", "mov"}, {".mkv", "matroska"}, {".webm", "webm"}};

Codec codec_of(const std::filesystem::path& path, const MovieSettings& settings) {
  return settings.codec.value_or(lower_ending(path) == ".webm" ? Codec::vp9 : Codec::h264);
}

const char* encoder_of(Codec codec) {
  switch (codec) {
    case Codec::h264:
      return "libx264";
    case Codec::h265:
      return "libx265";
    case Codec::vp9:
      break;
  }
  return "libvpx-vp9";
}

// The number of threads is part of what an encoder's bytes depend on.
std::vector<std::string> codec_arguments(Codec codec, int rate_factor) {
  const std::string quality = std::to_string(rate_factor);
  switch (codec) {
    case Codec::h264:
      return {"-c:v", encoder_of(codec), "-crf", quality, "-threads", "4"};
    case Codec::h265:
      return {"-c:v",         encoder_of(codec),
              "-crf",         quality,
              "-tag:v",       "hvc1",
              "-x265-params", "log-level=error:pools=4:frame-threads=2"};
    case Codec::vp9:
      return {"-c:v", encoder_of(codec), "-crf", quality, "-b:v", "0", "-threads", "4"};
  }
  return {};
}

constexpr const char* ten_bits = "yuv420p10le";

// ffmpeg's own words on the encoder tell which pixels it takes.
void check_ten_bits(const std::filesystem::path& path, Codec codec) {
  const ScratchText help;
  ChildProcess ffmpeg({"ffmpeg", "-hide_banner", "-h", std::string("encoder=") + encoder_of(codec)},
                      {-1, help.descriptor(), -1});
  ffmpeg.wait(std::chrono::seconds(10), [&] { return help.text().size(); });
  if (help.text().find(ten_bits) != std::string::npos) return;
  throw DataError(path.string() + ": found an ffmpeg whose " + encoder_of(codec) +
                  " has no 10 bits, expected one that has; leave out movie.bits, or choose another "
                  "movie.codec");
}

// ffmpeg takes what stands before a colon for a protocol.
std::string as_file(const std::filesystem::path& path) {
  return "file:" + path.string();
}

std::vector<std::string> arguments(const std::filesystem::path& path, const MovieSettings& settings,
                                   int width, int height, const std::filesystem::path& unfinished) {
  std::vector<std::string> all = {
      "ffmpeg", "-nostdin", "-hide_banner", "-loglevel", "error", "-f", "rawvideo", "-pixel_format",
      settings.bits == 10 ? "rgb48le" : "rgb24", "-video_size", fmt::format("{}x{}", width, height),
      "-framerate", fmt::format("{}", settings.frames_per_second), "-i", "pipe:0", "-an",
      // The colours of high-definition television, and said to be those: without, players
      // guess from the picture's size.
      "-vf",
      std::string("scale=in_range=full:out_range=limited:out_color_matrix=bt709:"
                  "flags=bicubic+accurate_rnd+full_chroma_int+bitexact,format=") +
          (settings.bits == 10 ? ten_bits : "yuv420p"),
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
  all.push_back(as_file(unfinished));
  return all;
}

std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n')
    text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

// A number that changes whenever the file is written to.
std::uint64_t state_of(const std::filesystem::path& path) {
  struct stat status = {};
  if (::stat(path.c_str(), &status) != 0) return 0;
  return static_cast<std::uint64_t>(status.st_size) * 1000003U +
         static_cast<std::uint64_t>(status.st_mtim.tv_sec) * 1000000007U +
         static_cast<std::uint64_t>(status.st_mtim.tv_nsec);
}

// The last "frame=N" of what ffmpeg's -progress writes.
std::uint64_t frames_in(const std::string& progress) {
  const std::string key = "frame=";
  const std::size_t last = progress.rfind(key);
  std::uint64_t frames = 0;
  if (last == std::string::npos) return 0;
  std::from_chars(progress.data() + last + key.size(), progress.data() + progress.size(), frames);
  return frames;
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
  if (find_program("ffmpeg").empty()) {
    throw DataError(path.string() +
                    ": films are made by ffmpeg, which is not installed (on Debian: apt-get "
                    "install ffmpeg); numbered images such as -o frame_%04d.png need none");
  }
  const ScratchText needed;  // by the encoder, when all frames have been drawn
  if (settings.bits == 10) check_ten_bits(path, codec_of(path, settings));
}

struct Encoder::Process {
  Process(const std::vector<std::string>& words, int input)
      : ffmpeg(words, {input, -1, messages.descriptor()}) {}

  ScratchText messages;
  ChildProcess ffmpeg;
};

Encoder::Encoder(const std::filesystem::path& path, const MovieSettings& settings, int width,
                 int height, std::chrono::milliseconds patience)
    : path_(path), patience_(patience), film_(path) {
  // A socket rather than a pipe: one whose other end is gone answers with an error, not with
  // a signal.
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    throw DataError("no connection to ffmpeg: " + reason(errno));
  }
  input_ = ends[0];
  try {
    process_ = std::make_unique<Process>(
        arguments(path, settings, width, height, film_.temporary_path()), ends[1]);
  } catch (...) {
    ::close(ends[0]);
    ::close(ends[1]);
    throw;
  }
  ::close(ends[1]);
}

Encoder::~Encoder() {
  end_input();
}

void Encoder::add(const std::vector<std::uint8_t>& picture) {
  const std::uint8_t* next = picture.data();
  std::size_t left = picture.size();
  while (left > 0) {
    wait_until_it_reads();
    const ssize_t sent = ::send(input_, next, left, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && (errno == EINTR || errno == EAGAIN || errno == EWOULDBLOCK)) continue;
    if (sent < 0) end_in_failure();
    next += sent;
    left -= static_cast<std::size_t>(sent);
  }
  ++frames_;
}

void Encoder::wait_until_it_reads() {
  const auto deadline = std::chrono::steady_clock::now() + patience_;
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        deadline - std::chrono::steady_clock::now());
    pollfd socket = {input_, POLLOUT, 0};
    const int ready = ::poll(&socket, 1, std::max(0, static_cast<int>(left.count())));
    if (ready > 0) return;
    if (ready == 0) {
      process_->ffmpeg.kill();
      fail_stuck("read nothing");
    }
    if (errno != EINTR) throw DataError("no connection to ffmpeg: " + reason(errno));
  }
}

void Encoder::finish() {
  end_input();
  switch (process_->ffmpeg.wait(patience_, [this] { return state_of(film_.temporary_path()); })) {
    case ChildProcess::End::stuck:
      fail_stuck("wrote nothing");
    case ChildProcess::End::failure:
      fail(process_->messages.text());
    case ChildProcess::End::success:
      break;
  }
  check_film_is_whole();
  film_.finish();
}

// ffmpeg itself reads what it has written: the container, not every pixel.
void Encoder::check_film_is_whole() {
  const ScratchText progress, messages;
  ChildProcess ffmpeg({"ffmpeg", "-nostdin", "-hide_banner", "-loglevel", "error", "-i",
                       as_file(film_.temporary_path()), "-map", "0:v:0", "-c", "copy", "-progress",
                       "pipe:1", "-f", "null", "-"},
                      {-1, progress.descriptor(), messages.descriptor()});
  const auto end = ffmpeg.wait(patience_, [&] { return frames_in(progress.text()); });
  const std::uint64_t found = frames_in(progress.text());
  if (end == ChildProcess::End::success && found == frames_) return;
  const std::string said = one_line(messages.text());
  throw DataError(
      fmt::format("{}: ffmpeg made a film in which it finds {} frames, expected {}{}; see that the "
                  "ffmpeg that is found first works, and try again",
                  path_.string(), found, frames_, said.empty() ? "" : fmt::format(" ({})", said)));
}

void Encoder::end_input() {
  if (input_ >= 0) ::close(input_);
  input_ = -1;
}

// It has closed its end: it says why when it ends.
void Encoder::end_in_failure() {
  end_input();
  const auto end =
      process_->ffmpeg.wait(patience_, [this] { return state_of(film_.temporary_path()); });
  if (end == ChildProcess::End::stuck) fail_stuck("closed its input and did not end");
  fail(process_->messages.text());
}

void Encoder::fail_stuck(const std::string& what) const {
  throw DataError(fmt::format(
      "{}: ffmpeg {} for {} s and was ended; the frames that were drawn are kept: see that ffmpeg "
      "works, and try again",
      path_.string(), what, std::chrono::duration_cast<std::chrono::seconds>(patience_).count()));
}

void Encoder::fail(const std::string& messages) const {
  const std::string said = one_line(messages);
  throw DataError(path_.string() + ": ffmpeg could not make the film: " +
                  (said.empty() ? "it ended without a word" : said));
}

}  // namespace splotchcl
