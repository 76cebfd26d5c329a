#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "openimageio/pictures.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// The numbers at the start of a file, most significant byte first or last.
class Header {
 public:
  explicit Header(const std::filesystem::path& path) {
    std::ifstream(path, std::ios::binary)
        .read(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
  }

  bool begins_with(std::string_view mark) const {
    return std::string_view(bytes_.data(), mark.size()) == mark;
  }
  void set_least_first(bool is_least_first) { is_least_first_ = is_least_first; }
  std::uint64_t number(std::size_t place, std::size_t size) const {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t next = place + (is_least_first_ ? size - 1 - i : i);
      value = value << 8 | static_cast<unsigned char>(bytes_[next]);
    }
    return value;
  }

 private:
  std::array<char, 2048> bytes_ = {};
  bool is_least_first_ = false;
};

// Of values one after the other, or with as many of them as fit into each word of 32 bits.
std::uint64_t line_bytes(std::uint64_t values, std::uint64_t bits, bool fills_words) {
  constexpr std::uint64_t word_bits = 32, word_bytes = 4;
  if (!fills_words || bits == 0 || bits > word_bits) return values * bits / 8;
  const std::uint64_t in_word = word_bits / bits;
  return (values + in_word - 1) / in_word * word_bytes;
}

// How many values a pixel of an element of DPX has, by its descriptor.
std::uint64_t values_of(std::uint64_t descriptor) {
  switch (descriptor) {
    case 50:
    case 102:
      return 3;
    case 51:
    case 52:
    case 103:
      return 4;
    case 100:
      return 2;
    default:
      return 1;
  }
}

std::optional<std::uint64_t> dpx_bytes(Header header) {
  const bool is_least_first = header.begins_with("XPDS");
  if (!is_least_first && !header.begins_with("SDPX")) return std::nullopt;
  header.set_least_first(is_least_first);
  constexpr std::size_t element = 780;
  const bool is_packed_in_runs = header.number(element + 26, 2) != 0;
  if (is_packed_in_runs) return std::nullopt;
  const std::uint64_t width = header.number(772, 4), height = header.number(776, 4);
  const std::uint64_t bits = header.number(element + 23, 1);
  const bool fills_words = bits == 10 && header.number(element + 24, 2) != 0;
  const std::uint64_t values = width * values_of(header.number(element + 20, 1));
  // Of 12 bits two bytes are filled.
  const bool fills_bytes = bits == 12 && header.number(element + 24, 2) != 0;
  return header.number(4, 4) + height * line_bytes(values, fills_bytes ? 16 : bits, fills_words);
}

std::optional<std::uint64_t> cineon_bytes(Header header) {
  const bool is_least_first = header.begins_with("\xd7\x5f\x2a\x80");
  if (!is_least_first && !header.begins_with("\x80\x2a\x5f\xd7")) return std::nullopt;
  header.set_least_first(is_least_first);
  const std::uint64_t channels = header.number(193, 1), bits = header.number(198, 1);
  const std::uint64_t packing = header.number(681, 1);
  const bool fills_words = packing == 5 || packing == 6;
  const std::uint64_t values = header.number(200, 4) * channels;
  return header.number(4, 4) + header.number(204, 4) * line_bytes(values, bits, fills_words);
}

// Of DPX and Cineon files, whose readers take what is missing at the end of one for black, or for
// what was in memory. Throws DataError for a file that is shorter than its header says.
void check_length_of_film_scan(const std::filesystem::path& path) {
  const Header header(path);
  const std::optional<std::uint64_t> dpx = dpx_bytes(header);
  const std::optional<std::uint64_t> expected = dpx ? dpx : cineon_bytes(header);
  std::error_code error;
  const std::uint64_t found = std::filesystem::file_size(path, error);
  if (error || !expected || found >= *expected) return;
  throw DataError(path.string() + ": ends after " + std::to_string(found) + " bytes, expected " +
                  std::to_string(*expected) + "; the file is cut: copy or write it again");
}

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
  return text.empty() ? "the library does not say how; it may be cut"
                      : text.substr(0, text.find('\n'));
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

Image read_stored(const std::filesystem::path& path) {
  const std::unique_ptr<OIIO::ImageInput> input = open_image(path);
  const OIIO::ImageSpec spec = input->spec();
  const auto channels = static_cast<std::size_t>(spec.nchannels);
  Image image(spec.width, spec.height);
  const std::size_t pixels = image.pixels.size() / 4;
  std::vector<float> values(channels * pixels);
  const bool complete =
      input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data());
  // A truncated TIFF file is an error that read_image does not return.
  if (!complete || input->has_error()) {
    throw DataError(path.string() + ": is damaged: " + first_line(input->geterror()));
  }
  const ChannelPlaces places = find_channels(spec);
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    const float* from = &values[channels * pixel];
    float* to = &image.pixels[4 * pixel];
    for (std::size_t i = 0; i < 3; ++i)
      to[i] = from[places.color[i]];
    to[3] = places.alpha < 0 ? 1.0F : from[places.alpha];
  }
  return image;
}

ImageFileInfo read_info(const std::filesystem::path& path) {
  const std::unique_ptr<OIIO::ImageInput> input = open_image(path);
  const OIIO::ImageSpec& spec = input->spec();
  ImageFileInfo info;
  info.width = spec.width;
  info.height = spec.height;
  info.has_alpha = spec.alpha_channel >= 0;
  info.is_float = spec.format.is_floating_point();
  for (const OIIO::ParamValue& attribute : spec.extra_attribs) {
    if (attribute.type() == OIIO::TypeDesc::STRING) {
      info.metadata[attribute.name().string()] = attribute.get_string();
    }
  }
  return info;
}

}  // namespace splotchcl
