#include "openimageio/input.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <system_error>

#include "splotchcl/error.h"

namespace splotchcl {

namespace {

// How many bytes of values a byte of a file can stand for at most, generously: what only copies
// values has few, runs have up to 128 or 255 pixels each, deflate makes up to 1032 bytes of one, of
// which each may be eight pixels.
struct Packing {
  const char* format;  // as OpenImageIO calls it
  std::uint64_t most;
};
constexpr Packing packings[] = {{"pnm", 32},    {"dds", 64},    {"hdr", 512},       {"targa", 1024},
                                {"bmp", 1024},  {"psd", 1024},  {"softimage", 512}, {"jpeg", 8192},
                                {"gif", 32768}, {"png", 65536}, {"tiff", 65536}};
constexpr std::uint64_t most_of_others = std::uint64_t{1} << 20;
constexpr std::uint64_t always_allowed = std::uint64_t{1} << 22;

// Before memory is claimed for what a file only says that it has.
void check_claim(const std::filesystem::path& path, const std::string& format,
                 const OIIO::ImageSpec& spec) {
  std::error_code error;
  const std::uint64_t bytes = std::filesystem::file_size(path, error);
  if (error) return;
  const auto* const known =
      std::find_if(std::begin(packings), std::end(packings),
                   [&](const Packing& packing) { return format == packing.format; });
  const std::uint64_t most = known == std::end(packings) ? most_of_others : known->most;
  const auto limit =
      static_cast<double>(always_allowed) + static_cast<double>(bytes) * static_cast<double>(most);
  const double claimed =
      1.0 * spec.width * spec.height * spec.nchannels * static_cast<double>(spec.format.size());
  if (spec.width >= 1 && spec.height >= 1 && claimed <= limit) return;
  throw DataError(path.string() + ": claims " + std::to_string(spec.width) + "x" +
                  std::to_string(spec.height) + " pixels, which " + std::to_string(bytes) +
                  " bytes cannot hold; the file is cut or damaged: copy or write it again");
}

}  // namespace

std::string first_line(const std::string& text) {
  return text.empty() ? "unknown error" : text.substr(0, text.find('\n'));
}

std::unique_ptr<OIIO::ImageInput> open_image(const std::filesystem::path& path,
                                             const OIIO::ImageSpec* hints) {
  std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path.string(), hints);
  if (!input) {
    throw DataError(path.string() +
                    ": cannot be read as a picture: " + first_line(OIIO::geterror()));
  }
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.deep || spec.depth > 1 || spec.nchannels < 1) {
    throw DataError(path.string() + ": is not a flat picture of colours");
  }
  check_claim(path, input->format_name(), spec);
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
