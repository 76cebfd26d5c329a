#include "openimageio/input.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>

#include "openimageio/film_scan_length.h"
#include "splotchcl/error.h"

namespace splotchcl {

namespace {

// How many bytes of values a byte of a file can stand for at most, generously: what only copies
// values has few, runs have up to 128 or 255 pixels each, deflate makes up to 1032 bytes of one, of
// which each may be eight pixels.
constexpr std::uint64_t most_of_gif = 32768;
struct Packing {
  const char* format;  // as OpenImageIO calls it
  std::uint64_t most;
};
constexpr Packing packings[] = {
    {"pnm", 32},    {"fits", 32},   {"cineon", 64},     {"dds", 64},    {"dpx", 512},
    {"hdr", 512},   {"rla", 512},   {"softimage", 512}, {"bmp", 1024},  {"iff", 1024},
    {"psd", 1024},  {"sgi", 1024},  {"targa", 1024},    {"jpeg", 8192}, {"gif", most_of_gif},
    {"ico", 65536}, {"png", 65536}, {"tiff", 65536}};
constexpr std::uint64_t most_of_others = std::uint64_t{1} << 20;
constexpr std::uint64_t always_allowed = std::uint64_t{1} << 22;

// Before memory is claimed for what a file only says that it has.
void check_claim(const std::filesystem::path& path, int width, int height, double pixel_bytes,
                 std::uint64_t most) {
  std::error_code error;
  const std::uint64_t bytes = std::filesystem::file_size(path, error);
  if (error) return;
  const auto limit =
      static_cast<double>(always_allowed) + static_cast<double>(bytes) * static_cast<double>(most);
  if (width >= 1 && height >= 1 && pixel_bytes * width * height <= limit) return;
  throw DataError(path.string() + ": claims " + std::to_string(width) + "x" +
                  std::to_string(height) + " pixels, which " + std::to_string(bytes) +
                  " bytes cannot hold; the file is cut or damaged: copy or write it again");
}

void check_claim(const std::filesystem::path& path, const std::string& format,
                 const OIIO::ImageSpec& spec) {
  const auto* const known =
      std::find_if(std::begin(packings), std::end(packings),
                   [&](const Packing& packing) { return format == packing.format; });
  check_claim(path, spec.width, spec.height,
              spec.nchannels * static_cast<double>(spec.format.size()),
              known == std::end(packings) ? most_of_others : known->most);
}

// Of a GIF the library takes the memory when it opens it: its size stands after "GIF89a".
void check_claim_of_gif(const std::filesystem::path& path) {
  std::array<char, 10> head = {};
  std::ifstream(path, std::ios::binary).read(head.data(), head.size());
  if (std::string_view(head.data(), 4) != "GIF8") return;
  const auto number = [&head](std::size_t place) {
    return static_cast<unsigned char>(head[place]) +
           256 * static_cast<unsigned char>(head[place + 1]);
  };
  constexpr double bytes_of_pixel = 4;
  check_claim(path, number(6), number(8), bytes_of_pixel, most_of_gif);
}

}  // namespace

std::string first_line(const std::string& text) {
  return text.empty() ? "the library does not say how; it may be cut" : text.substr(0, text.find('\n'));
}

std::unique_ptr<OIIO::ImageInput> open_image(const std::filesystem::path& path,
                                             const OIIO::ImageSpec* hints) {
  check_claim_of_gif(path);
  std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path.string(), hints);
  if (!input) {
    throw DataError(path.string() +
                    ": cannot be read as a picture: " + first_line(OIIO::geterror()));
  }
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.deep || spec.depth > 1 || spec.nchannels < 1) {
    throw DataError(path.string() + ": is not a flat picture of colours");
  }
  if (std::string_view(input->format_name()) == "zfile") {
    throw DataError(path.string() + ": is a map of depths, expected a picture");
  }
  check_claim(path, input->format_name(), spec);
  check_length_of_film_scan(path);
  return input;
}

ChannelPlaces find_channels(const OIIO::ImageSpec& spec) {
  ChannelPlaces places;
  places.alpha = spec.alpha_channel;
  const int red = spec.channelindex("R");
  const int green = spec.channelindex("G");
  const int blue = spec.channelindex("B");
  if (red >= 0 && green >= 0 && blue >= 0) {
    places.color = {red, green, blue};
  } else if (spec.nchannels >= 3) {
    places.color = {0, 1, 2};
  }
  return places;
}

}  // namespace splotchcl
