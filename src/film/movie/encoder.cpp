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
#include "common/words.h"
#include "film/movie/codecs.h"
#include "splotchcl/error.h"
#include "system/system.h"

namespace splotchcl {
namespace {

// ffmpeg's name of the container, by a file's ending.
const std::map<std::string, std::string> containers = {
    {".mp4", "mp4"}, {".mov", "mov"}, {".mkv", "matroska"}, {".webm", "webm"}};

// ffmpeg's own words on an encoder, which tell the pixels that it takes.
std::string encoder_help(const char* encoder) {
  const ScratchText help;
  ChildProcess ffmpeg({"ffmpeg", "-hide_banner", "-h", std::string("encoder=") + encoder},
                      {-1, help.descriptor(), -1});
  ffmpeg.wait(std::chrono::seconds(10), [&] { return help.text().size(); });
  return help.text();
}

void check_encoder(const std::filesystem::path& path, const CodecFacts& facts, int bits) {
  const std::string help = encoder_help(facts.encoder);
  const bool is_everywhere =
      facts.codec == Codec::h264 || facts.codec == Codec::h265 || facts.codec == Codec::vp9;
  if (!is_everywhere && help.find(std::string("Encoder ") + facts.encoder) == std::string::npos) {
    throw DataError(path.string() + ": found an ffmpeg without the encoder " + facts.encoder +
                    ", expected one that has it; choose another movie.codec");
  }
  if (bits == 8 || help.find(facts.pixels_of_ten_bits) != std::string::npos) return;
  throw DataError(path.string() + ": found an ffmpeg whose " + facts.encoder +
                  " has no 10 bits, expected one that has; leave out movie.bits, or choose another "
                  "movie.codec");
}

// Those of MP4 and QuickTime.
bool has_boxes(const std::filesystem::path& path) {
  return lower_ending(path) == ".mp4" || lower_ending(path) == ".mov";
}

// ffmpeg takes what stands before a colon for a protocol.
std::string as_file(const std::filesystem::path& path) {
  return "file:" + path.string();
}

// Sound is as long as the film: silent where it ends earlier.
std::vector<std::string> sound_of(const std::filesystem::path& path, const CodecFacts& facts) {
  std::vector<std::string> words = {"-map", "0:v:0",    "-map",      "1:a:0",    "-af",
                                    "apad", "-flags:a", "+bitexact", "-shortest"};
  const std::vector<std::string> codec = sound_arguments(path, facts);
  words.insert(words.end(), codec.begin(), codec.end());
  return words;
}

// Matroska has words of its own for two eyes.
std::vector<std::string> eyes_of(const std::filesystem::path& path, const FilmLayout& layout) {
  if (layout.eyes == FilmLayout::Eyes::one || has_boxes(path)) return {};
  const bool is_beside = layout.eyes == FilmLayout::Eyes::side_by_side;
  return {"-metadata:s:v:0",
          std::string("stereo_mode=") + (is_beside ? "left_right" : "top_bottom")};
}

std::vector<std::string> x264_parameters(const CodecFacts& facts, const FilmLayout& layout) {
  if (facts.codec != Codec::h264) return {};
  // x264 that looks ahead in a thread of its own writes other bytes now and then on a busy machine
  // (1 film in 30); without that thread it is as fast.
  std::string parameters = "sync-lookahead=0";
  // Each picture says by itself how two eyes are packed, squeezed or not: screens that know no
  // boxes look there.
  if (layout.eyes == FilmLayout::Eyes::side_by_side) parameters += ":frame-packing=3";
  if (layout.eyes == FilmLayout::Eyes::top_bottom) parameters += ":frame-packing=4";
  return {"-x264-params", parameters};
}

std::vector<std::string> arguments(const std::filesystem::path& path, const MovieSettings& settings,
                                   int width, int height, const FilmLayout& layout,
                                   const std::filesystem::path& unfinished) {
  const CodecFacts& facts = codec_facts(path, settings);
  const int bits = film_bits(path, settings);
  std::vector<std::string> all = {"ffmpeg",
                                  "-nostdin",
                                  "-hide_banner",
                                  "-loglevel",
                                  "error",
                                  "-f",
                                  "rawvideo",
                                  "-pixel_format",
                                  bits == 10 ? "rgb48le" : "rgb24",
                                  "-video_size",
                                  fmt::format("{}x{}", width, height),
                                  "-framerate",
                                  fmt::format("{}", settings.frames_per_second),
                                  "-i",
                                  "pipe:0"};
  const auto add = [&all](const std::vector<std::string>& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  if (settings.audio.empty()) {
    add({"-an"});
  } else {
    add({"-i", as_file(settings.audio)});
  }
  add(color_arguments(facts, bits));
  add(codec_arguments(facts, settings, bits));
  add(x264_parameters(facts, layout));
  if (!settings.audio.empty()) add(sound_of(path, facts));
  // No times and versions in the file.
  add({"-flags:v", "+bitexact", "-fflags", "+bitexact", "-map_metadata", "-1"});
  add(eyes_of(path, layout));
  add({"-movflags", "+faststart", "-f", containers.at(lower_ending(path)), "-y",
       as_file(unfinished)});
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
  const timespec written = of_system::written_at(status);
  return static_cast<std::uint64_t>(status.st_size) * 1000003U +
         static_cast<std::uint64_t>(written.tv_sec) * 1000000007U +
         static_cast<std::uint64_t>(written.tv_nsec);
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

namespace {

void check_ending(const std::filesystem::path& path, const CodecFacts& facts) {
  const std::vector<std::string>& endings = facts.endings;
  if (std::count(endings.begin(), endings.end(), lower_ending(path)) > 0) return;
  throw UsageError(
      fmt::format("{}: found a film of {}, which is held by {}; choose such a name, or "
                  "another movie.codec",
                  path.string(), facts.name, fmt::join(endings, ", ")));
}

void check_sides(const std::filesystem::path& path, const CodecFacts& facts, int width,
                 int height) {
  const int step = facts.side_step;
  if (width % step == 0 && height % step == 0) return;
  throw UsageError(fmt::format(
      "{}: found pictures of {}x{} pixels, expected {}, as films of {} need; change image.size, or "
      "write numbered images such as frame_%04d.png",
      path.string(), width, height,
      step == 2 ? "even numbers" : fmt::format("multiples of {}", step), facts.name));
}

// ffmpeg finds sound in it.
void check_sound(const std::string& audio) {
  const ScratchText messages;
  ChildProcess ffmpeg({"ffmpeg", "-nostdin", "-hide_banner", "-loglevel", "error", "-i",
                       as_file(audio), "-map", "0:a:0", "-t", "0.1", "-f", "null", "-"},
                      {-1, -1, messages.descriptor()});
  const auto end = ffmpeg.wait(std::chrono::seconds(60), [&] { return messages.text().size(); });
  if (end == ChildProcess::End::success) return;
  throw DataError(
      fmt::format("{}: found no sound that ffmpeg can read, expected a file such as "
                  "music.wav ({})",
                  audio, one_line(messages.text())));
}

}  // namespace

void check_film(const std::filesystem::path& path, const MovieSettings& settings, int width,
                int height) {
  const CodecFacts& facts = codec_facts(path, settings);
  check_ending(path, facts);
  check_sides(path, facts, width, height);
  if (settings.bits == 10 && facts.pixels_of_ten_bits == nullptr) {
    throw UsageError(path.string() + ": found movie.bits = 10 with " + facts.name +
                     ", which has 8; leave out movie.bits");
  }
  if (find_program("ffmpeg").empty()) {
    throw DataError(path.string() +
                    ": films are made by ffmpeg, which is not installed (on Debian: apt-get "
                    "install ffmpeg); numbered images such as -o frame_%04d.png need none");
  }
  // What is needed when all frames have been drawn.
  const ScratchText needed;
  const int bits = film_bits(path, settings);
  const bool is_everywhere =
      facts.codec == Codec::h264 || facts.codec == Codec::h265 || facts.codec == Codec::vp9;
  if (bits == 10 || !is_everywhere) check_encoder(path, facts, bits);
  if (!settings.audio.empty()) check_sound(settings.audio);
}

struct Encoder::Process {
  Process(const std::vector<std::string>& words, int input)
      : ffmpeg(words, {input, -1, messages.descriptor()}) {}

  ScratchText messages;
  ChildProcess ffmpeg;
};

Encoder::Encoder(const std::filesystem::path& path, const MovieSettings& settings, int width,
                 int height, const FilmLayout& layout, std::chrono::milliseconds patience)
    : path_(path), layout_(layout), patience_(patience), film_(path) {
  // A socket rather than a pipe: one whose other end is gone answers with an error, not with
  // a signal.
  int ends[2];
  if (!of_system::connect_ends(ends)) {
    throw DataError("no connection to ffmpeg: " + reason(errno));
  }
  input_ = ends[0];
  try {
    process_ = std::make_unique<Process>(
        arguments(path, settings, width, height, layout, film_.temporary_path()), ends[1]);
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
    const ssize_t sent = of_system::send_without_signal(input_, next, left, MSG_DONTWAIT);
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
  if (!layout_.is_plain() && has_boxes(path_)) write_layout(film_.temporary_path(), layout_);
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
