#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "splotchcl/movie.h"

namespace splotchcl {

// How ffmpeg makes films of one codec.
struct CodecFacts {
  Codec codec;
  const char* name;                  // as scenes have it
  const char* encoder;               // ffmpeg's
  std::vector<std::string> endings;  // of films that hold it
  const char* pixels;                // of 8 bits; null: has none
  const char* pixels_of_ten_bits;    // null: has none
  int side_step;                     // sides are multiples of it
  bool is_rgb;                       // else YUV as high-definition television has it
};

// That of the settings, or of the film's ending.
const CodecFacts& codec_facts(const std::filesystem::path& path, const MovieSettings& settings);

// 8 or 10: a codec that has only one of them has that whatever the settings say by default.
int film_bits(const std::filesystem::path& path, const MovieSettings& settings);

// Names the encoder and how well it is to encode.
std::vector<std::string> codec_arguments(const CodecFacts& facts, const MovieSettings& settings,
                                         int bits);
// The filter to the codec's pixels, and what players are told of colors.
std::vector<std::string> color_arguments(const CodecFacts& facts, int bits);
// How sound is encoded beside it.
std::vector<std::string> sound_arguments(const std::filesystem::path& path,
                                         const CodecFacts& facts);

}  // namespace splotchcl
