#include "film/movie/codecs.h"

#include <algorithm>
#include <array>

#include "common/words.h"

namespace splotchcl {
namespace {

const std::array<CodecFacts, 8>& all_codecs() {
  static const std::array<CodecFacts, 8> codecs = {{
      {Codec::h264,
       "h264",
       "libx264",
       {".mp4", ".mov", ".mkv"},
       "yuv420p",
       "yuv420p10le",
       2,
       false},
      {Codec::h265,
       "h265",
       "libx265",
       {".mp4", ".mov", ".mkv"},
       "yuv420p",
       "yuv420p10le",
       2,
       false},
      {Codec::vp9,
       "vp9",
       "libvpx-vp9",
       {".webm", ".mp4", ".mov", ".mkv"},
       "yuv420p",
       "yuv420p10le",
       2,
       false},
      {Codec::av1,
       "av1",
       "libaom-av1",
       {".mp4", ".webm", ".mkv"},
       "yuv420p",
       "yuv420p10le",
       2,
       false},
      {Codec::prores, "prores", "prores_ks", {".mov", ".mkv"}, nullptr, "yuv422p10le", 2, false},
      {Codec::dnxhr, "dnxhr", "dnxhd", {".mov", ".mkv"}, "yuv422p", "yuv422p10le", 2, false},
      {Codec::hap, "hap", "hap", {".mov"}, "rgba", nullptr, 4, true},
      {Codec::ffv1, "ffv1", "ffv1", {".mkv"}, "bgr0", "gbrp10le", 1, true},
  }};
  return codecs;
}

}  // namespace

const CodecFacts& codec_facts(const std::filesystem::path& path, const MovieSettings& settings) {
  const Codec codec =
      settings.codec.value_or(lower_ending(path) == ".webm" ? Codec::vp9 : Codec::h264);
  return *std::find_if(all_codecs().begin(), all_codecs().end(),
                       [codec](const CodecFacts& facts) { return facts.codec == codec; });
}

int film_bits(const std::filesystem::path& path, const MovieSettings& settings) {
  return codec_facts(path, settings).pixels == nullptr ? 10 : settings.bits;
}

// The number of threads is part of what an encoder's bytes depend on.
std::vector<std::string> codec_arguments(const CodecFacts& facts, const MovieSettings& settings,
                                         int bits) {
  const std::string quality = std::to_string(settings.rate_factor);
  std::vector<std::string> words = {"-c:v", facts.encoder};
  const auto add = [&words](const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
  };
  switch (facts.codec) {
    case Codec::h264:
      add({"-crf", quality, "-threads", "4"});
      break;
    case Codec::h265:
      add({"-crf", quality, "-tag:v", "hvc1", "-x265-params",
           "log-level=error:pools=4:frame-threads=2"});
      break;
    case Codec::vp9:
      add({"-crf", quality, "-b:v", "0", "-threads", "4"});
      break;
    case Codec::av1:
      add({"-crf", quality, "-b:v", "0", "-cpu-used", "6", "-row-mt", "1", "-threads", "4"});
      break;
    case Codec::prores:
      add({"-profile:v", "hq", "-vendor", "apl0", "-threads", "4"});
      break;
    case Codec::dnxhr:
      add({"-profile:v", bits == 10 ? "dnxhr_hqx" : "dnxhr_hq", "-threads", "4"});
      break;
    case Codec::hap:
      add({"-format", "hap_q", "-chunks", "4", "-threads", "4"});
      break;
    case Codec::ffv1:
      add({"-level", "3", "-g", "1", "-slices", "4", "-slicecrc", "1", "-threads", "4"});
      break;
  }
  return words;
}

// Without being told, players guess the colors from the picture's size.
std::vector<std::string> color_arguments(const CodecFacts& facts, int bits) {
  const std::string pixels = bits == 10 ? facts.pixels_of_ten_bits : facts.pixels;
  if (facts.is_rgb) return {"-vf", "format=" + pixels};
  return {"-vf",
          "scale=in_range=full:out_range=limited:out_color_matrix=bt709:"
          "flags=bicubic+accurate_rnd+full_chroma_int+bitexact,format=" +
              pixels,
          "-colorspace",
          "bt709",
          "-color_primaries",
          "bt709",
          "-color_trc",
          "bt709",
          "-color_range",
          "tv"};
}

// Masters keep all of it.
std::vector<std::string> sound_arguments(const std::filesystem::path& path,
                                         const CodecFacts& facts) {
  if (lower_ending(path) == ".webm") return {"-c:a", "libopus", "-b:a", "192k"};
  const bool is_master = facts.codec == Codec::prores || facts.codec == Codec::dnxhr ||
                         facts.codec == Codec::hap || facts.codec == Codec::ffv1;
  if (is_master) return {"-c:a", lower_ending(path) == ".mkv" ? "flac" : "pcm_s24le"};
  return {"-c:a", "aac", "-b:a", "256k"};
}

}  // namespace splotchcl
