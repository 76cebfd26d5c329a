#include <algorithm>
#include <array>
#include <cmath>
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
#include <utility>
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

namespace {

// Where a picture's first row and column are shown, as EXIF and TIFF say it; 1: above and left.
int orientation_of(const OIIO::ImageSpec& spec) {
  const int orientation = spec.get_int_attribute("Orientation", 1);
  return orientation >= 1 && orientation <= 8 ? orientation : 1;
}

// From 5 on rows are shown as columns.
bool is_turned(const OIIO::ImageSpec& spec) {
  return orientation_of(spec) >= 5;
}

// As viewers show it: cameras write rows as their sensor has them, and how they were held beside.
Image upright(const OIIO::ImageSpec& spec, Image stored) {
  const int orientation = orientation_of(spec);
  if (orientation == 1) return stored;
  constexpr unsigned with_last_column_first = 1U << 2 | 1U << 3 | 1U << 7 | 1U << 8,
                     with_last_row_first = 1U << 3 | 1U << 4 | 1U << 6 | 1U << 7;
  const bool mirrors_columns = (with_last_column_first >> orientation & 1U) != 0,
             mirrors_rows = (with_last_row_first >> orientation & 1U) != 0;
  const bool turns = is_turned(spec);
  Image image = turns ? Image(stored.height, stored.width) : Image(stored.width, stored.height);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const int column = turns ? y : x, row = turns ? x : y;
      std::copy_n(stored.at(mirrors_columns ? stored.width - 1 - column : column,
                            mirrors_rows ? stored.height - 1 - row : row),
                  4, image.at(x, y));
    }
  }
  return image;
}

}  // namespace

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
  return upright(spec, std::move(image));
}

ImageFileInfo read_info(const std::filesystem::path& path) {
  const std::unique_ptr<OIIO::ImageInput> input = open_image(path);
  const OIIO::ImageSpec& spec = input->spec();
  ImageFileInfo info;
  info.width = is_turned(spec) ? spec.height : spec.width;
  info.height = is_turned(spec) ? spec.width : spec.height;
  info.has_alpha = spec.alpha_channel >= 0;
  info.is_float = spec.format.is_floating_point();
  for (const OIIO::ParamValue& attribute : spec.extra_attribs) {
    if (attribute.type() == OIIO::TypeDesc::STRING) {
      info.metadata[attribute.name().string()] = attribute.get_string();
    }
  }
  return info;
}

namespace {

constexpr double usual_gamma = 2.2;
constexpr int rows_in_band = 64;

bool is_stored_as_floats(const OIIO::ImageSpec& spec) {
  return spec.format.is_floating_point();
}

// Reads a picture's values from top to bottom, a band of whole rows at a time. Whole numbers
// come as 16 bits, so that a table turns them into light.
class BandReader {
 public:
  explicit BandReader(const std::filesystem::path& path) : path_(path) {
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1);  // premultiplied light, not stored values
    input_ = open_image(path, &hints);
    spec_ = input_->spec();
    places_ = find_channels(spec_);
    alpha_multiplies_ = spec_.get_int_attribute("oiio:UnassociatedAlpha") != 0;
  }

  const OIIO::ImageSpec& spec() const { return spec_; }
  const ChannelPlaces& places() const { return places_; }
  bool alpha_multiplies() const { return alpha_multiplies_; }
  // Tiles cannot be read in part.
  int band_height() const {
    return spec_.tile_height > 0 ? spec_.tile_height : std::min(rows_in_band, spec_.height);
  }

  template <typename T>
  void read(int first_row, int rows, OIIO::TypeDesc type, std::vector<T>& values) {
    values.resize(static_cast<std::size_t>(spec_.nchannels) *
                  static_cast<std::size_t>(spec_.width) * static_cast<std::size_t>(rows));
    const int begin = spec_.y + first_row;
    const bool good =
        spec_.tile_height > 0
            ? input_->read_tiles(0, 0, spec_.x, spec_.x + spec_.width, begin, begin + rows, spec_.z,
                                 spec_.z + 1, 0, spec_.nchannels, type, values.data())
            : input_->read_scanlines(0, 0, begin, begin + rows, spec_.z, 0, spec_.nchannels, type,
                                     values.data());
    if (!good || input_->has_error()) {
      throw DataError(path_.string() + ": is damaged: " + first_line(input_->geterror()));
    }
  }

 private:
  std::filesystem::path path_;
  std::unique_ptr<OIIO::ImageInput> input_;
  OIIO::ImageSpec spec_;
  ChannelPlaces places_;
  bool alpha_multiplies_ = false;
};

// Light by stored value of 16 bits.
std::vector<float> light_table(double gamma) {
  constexpr std::size_t values = 65536;
  std::vector<float> table(values);
  for (std::size_t i = 0; i < values; ++i) {
    table[i] = static_cast<float>(std::pow(static_cast<double>(i) / (values - 1), gamma));
  }
  return table;
}

// Sums over squares of `side` pixels of the file.
class Averager {
 public:
  Averager(int width, int height, int side)
      : side_(side),
        width_(width),
        height_(height),
        image_((width + side - 1) / side, (height + side - 1) / side),
        sums_(image_.pixels.size()) {}

  void add(int x, int y, const float (&rgba)[4]) {
    const std::size_t pixel =
        static_cast<std::size_t>(y / side_) * static_cast<std::size_t>(image_.width) +
        static_cast<std::size_t>(x / side_);
    for (std::size_t i = 0; i < 4; ++i)
      sums_[4 * pixel + i] += static_cast<double>(rgba[i]);
  }

  Image finish() && {
    for (int y = 0; y < image_.height; ++y) {
      for (int x = 0; x < image_.width; ++x) {
        // The last row and column of squares may be cut by the picture's edge.
        const double count = static_cast<double>(std::min(side_, width_ - x * side_)) *
                             static_cast<double>(std::min(side_, height_ - y * side_));
        float* const pixel = image_.at(x, y);
        const auto first = static_cast<std::size_t>(pixel - image_.pixels.data());
        for (std::size_t i = 0; i < 4; ++i)
          pixel[i] = static_cast<float>(sums_[first + i] / count);
      }
    }
    return std::move(image_);
  }

 private:
  int side_, width_, height_;
  Image image_;
  std::vector<double> sums_;
};

int square_side(const OIIO::ImageSpec& spec, int longest_side) {
  if (longest_side <= 0) return 1;
  const int longest = std::max(spec.width, spec.height);
  return (longest + longest_side - 1) / longest_side;
}

// Calls visit(x, y, values of the pixel) for every pixel.
template <typename T, typename Visit>
void for_each_pixel(BandReader& reader, OIIO::TypeDesc type, Visit&& visit) {
  const OIIO::ImageSpec& spec = reader.spec();
  const auto channels = static_cast<std::size_t>(spec.nchannels);
  std::vector<T> values;
  for (int first = 0; first < spec.height; first += reader.band_height()) {
    const int rows = std::min(reader.band_height(), spec.height - first);
    reader.read(first, rows, type, values);
    const T* pixel = values.data();
    for (int y = first; y < first + rows; ++y) {
      for (int x = 0; x < spec.width; ++x, pixel += channels)
        visit(x, y, pixel);
    }
  }
}

void add_whole_numbers(BandReader& reader, double gamma, Averager& sums) {
  const std::vector<float> table = light_table(gamma);
  const ChannelPlaces places = reader.places();
  for_each_pixel<std::uint16_t>(
      reader, OIIO::TypeDesc::UINT16, [&](int x, int y, const std::uint16_t* from) {
        const float alpha =
            places.alpha < 0 ? 1.0F : static_cast<float>(from[places.alpha]) / 65535.0F;
        const float factor = reader.alpha_multiplies() ? alpha : 1.0F;
        sums.add(x, y,
                 {factor * table[from[places.color[0]]], factor * table[from[places.color[1]]],
                  factor * table[from[places.color[2]]], alpha});
      });
}

void add_floats(BandReader& reader, double gamma, const std::filesystem::path& path,
                Averager& sums) {
  const ChannelPlaces places = reader.places();
  for_each_pixel<float>(reader, OIIO::TypeDesc::FLOAT, [&](int x, int y, const float* from) {
    const float alpha = places.alpha < 0 ? 1.0F : from[places.alpha];
    float rgba[4] = {0, 0, 0, alpha};
    for (std::size_t i = 0; i < 3; ++i) {
      const float value = from[places.color[i]];
      const bool has_light = std::isfinite(value) && (gamma == 1 || value >= 0);
      if (!has_light || !std::isfinite(alpha)) {
        throw DataError(path.string() + ": holds " + std::to_string(value) + " at pixel " +
                        std::to_string(x) + "," + std::to_string(y) +
                        ", expected a finite amount of light >= 0; repair the picture");
      }
      const float light =
          gamma == 1 ? value : static_cast<float>(std::pow(static_cast<double>(value), gamma));
      rgba[i] = reader.alpha_multiplies() ? alpha * light : light;
    }
    sums.add(x, y, rgba);
  });
}

}  // namespace

Image read_linear(const std::filesystem::path& path, const LinearImageOptions& options) {
  BandReader reader(path);
  const OIIO::ImageSpec& spec = reader.spec();
  const bool floats = is_stored_as_floats(spec);
  const double gamma = options.gamma.value_or(floats ? 1.0 : usual_gamma);
  Averager sums(spec.width, spec.height, square_side(spec, options.longest_side));
  if (floats) {
    add_floats(reader, gamma, path, sums);
  } else {
    add_whole_numbers(reader, gamma, sums);
  }
  return upright(spec, std::move(sums).finish());
}

}  // namespace splotchcl
