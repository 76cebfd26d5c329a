#include "splotchcl/image_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "common/guards.h"
#include "common/mapped_file.h"
#include "common/unfinished_file.h"
#include "common/words.h"
#include "image/image_library.h"
#include "image/picture_encoders.h"
#include "modules/module_file.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using Metadata = std::map<std::string, std::string>;
using EncodeLight = std::vector<unsigned char>(const std::filesystem::path& path,
                                               const Image& image, const Metadata& metadata);

// A line for each.
std::string tell_light(const Metadata& metadata) {
  std::string text;
  for (const std::string& name : light_metadata()) {
    const auto found = metadata.find(name);
    if (found != metadata.end()) text += name + ": " + found->second + "\n";
  }
  return text;
}

std::vector<unsigned char> encode_light_as_tiff(const std::filesystem::path& path,
                                                const Image& image, const Metadata& metadata) {
  return encode_tiff(path, image, tell_light(metadata));
}

std::vector<unsigned char> encode_light_as_hdr(const std::filesystem::path& path,
                                               const Image& image, const Metadata& metadata) {
  return encode_hdr(path, image, tell_light(metadata));
}

constexpr int any_side = std::numeric_limits<int>::max();

// A format that can be written, by the ending of a file's name.
struct Format {
  const char* ending;
  EncodeLight* encode_light = nullptr;  // linear floats; null: 8 bits
  int longest_side = any_side;
  bool holds_words = false;  // 8 or 16 bits, if asked for
};

// Those that can be encoded in memory: writing the bytes is then ours to check.
// (On a full disk, and for a picture that is too large, libjpeg ends the whole program.)
constexpr std::array<Format, 13> formats = {{{"png", nullptr, any_side, true},
                                             {"jpg", nullptr, 65500},
                                             {"jpeg", nullptr, 65500},
                                             {"tga", nullptr, 65535},
                                             {"bmp"},
                                             {"ppm"},
                                             {"pnm"},
                                             {"webp", nullptr, 16383},
                                             {"jp2"},
                                             {"exr", encode_exr},
                                             {"tif", encode_light_as_tiff, any_side, true},
                                             {"tiff", encode_light_as_tiff, any_side, true},
                                             {"hdr", encode_light_as_hdr, 26754}}};

std::string endings() {
  std::string list;
  for (const Format& format : formats)
    list += std::string(list.empty() ? "." : ", .") + format.ending;
  return list;
}

const Format& format_of(const std::filesystem::path& path) {
  const std::string ending = lower_ending(path);
  const auto found = std::find_if(formats.begin(), formats.end(), [&](const Format& format) {
    return ending == std::string(".") + format.ending;
  });
  if (found != formats.end()) return *found;
  const std::string problem =
      ending.empty() ? "has no ending" : "its ending " + ending + " names no image format";
  throw UsageError(path.string() + ": " + problem + "; the ending chooses one of " + endings());
}

// The whole file, as bytes.
std::vector<unsigned char> encode(const std::filesystem::path& path, const Image& image,
                                  const ImageFileOptions& options) {
  const Format& format = format_of(path);
  if (holds_floats(path, options.bits)) return format.encode_light(path, image, options.metadata);
  if (options.bits == 16) {
    const std::vector<std::uint16_t> words = display_words(path, image, options);
    return format.encode_light != nullptr ? encode_tiff(path, image.width, image.height, words)
                                          : encode_png(path, image.width, image.height, words);
  }
  const std::vector<std::uint8_t> bytes = display_bytes(path, image, options);
  if (format.encode_light != nullptr) return encode_tiff(path, image.width, image.height, bytes);
  if (std::string(format.ending) == "png") {
    return encode_png(path, image.width, image.height, bytes);
  }
  StoredPicture picture;
  picture.width = image.width;
  picture.height = image.height;
  picture.pixels = bytes.data();
  return image_library().encode(path, format.ending, picture);
}

void check_readable(const std::filesystem::path& path) {
  require_regular_file(path);
  std::error_code ignored;
  // Some of the system's own files claim it, and keep their reader waiting.
  if (std::filesystem::file_size(path, ignored) == 0)
    throw DataError(path.string() + ": is empty, expected a picture: copy or write it again");
  check_exr_header(path);
}

}  // namespace

void check_image_path(const std::filesystem::path& path) {
  (void)format_of(path);
  check_output_path(path);
}

void check_image_size(const std::filesystem::path& path, int width, int height) {
  const Format& format = format_of(path);
  if (std::max(width, height) <= format.longest_side) return;
  throw UsageError(path.string() + ": " + std::to_string(width) + "x" + std::to_string(height) +
                   " pixels do not fit into ." + format.ending + ", which holds up to " +
                   std::to_string(format.longest_side) + " a side; choose .png or .exr");
}

const std::vector<std::string>& light_metadata() {
  static const std::vector<std::string> names = {"splotchcl:light", "splotchcl:exposure",
                                                 "splotchcl:white"};
  return names;
}

bool holds_floats(const std::filesystem::path& path, std::optional<int> bits) {
  const Format& format = format_of(path);
  return format.encode_light != nullptr && !(format.holds_words && bits);
}

void check_image_bits(const std::filesystem::path& path, std::optional<int> bits) {
  const Format& format = format_of(path);
  if (bits.value_or(8) == 8 || format.encode_light != nullptr || format.holds_words) return;
  throw UsageError(path.string() + ": found image.bits = " + std::to_string(*bits) +
                   ", expected 8, which is what ." + format.ending +
                   " holds; choose .png or .tif for 16 bits");
}

void write_image(const std::filesystem::path& path, const Image& image,
                 const ImageFileOptions& options) {
  check_image_size(path, image.width, image.height);
  check_image_bits(path, options.bits);
  const std::vector<unsigned char> bytes = encode(path, image, options);
  UnfinishedFile file(path);
  file.write(bytes.data(), bytes.size());
  file.finish();
}

Image read_image(const std::filesystem::path& path) {
  check_readable(path);
  const QuietErrors quiet;
  return image_library().read(path);
}

Image read_linear_image(const std::filesystem::path& path, const LinearImageOptions& options) {
  check_readable(path);
  const QuietErrors quiet;
  return image_library().read_linear(path, options);
}

ImageFileInfo read_image_info(const std::filesystem::path& path) {
  check_readable(path);
  const QuietErrors quiet;
  return image_library().read_info(path);
}

namespace {

const ImageLibrary& load() {
  void* const entry =
      module_entry("libsplotchcl_openimageio.so", image_library_entry, "pictures need",
                   "it belongs beside the program, or beside libsplotchcl, and is in Debian's "
                   "package splotchcl-openimageio");
  return *reinterpret_cast<ImageLibraryEntry*>(entry)();
}

}  // namespace

const ImageLibrary& image_library() {
  static const ImageLibrary& library = load();
  return library;
}

namespace {

void check_light(const std::filesystem::path& path, const Image& image) {
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const float value = image.pixels[i];
    if (i % 4 == 3 || (std::isfinite(value) && value >= 0)) continue;
    const std::size_t pixel = i / 4, row = static_cast<std::size_t>(image.width);
    throw DataError(path.string() + ": found the light " + std::to_string(value) + " at pixel " +
                    std::to_string(pixel % row) + "," + std::to_string(pixel / row) +
                    ", expected finite values >= 0 in a background");
  }
}

void make_linear(Image& image, double gamma) {
  if (gamma == 1) return;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (i % 4 != 3) image.pixels[i] = std::pow(image.pixels[i], static_cast<float>(gamma));
  }
}

// The middle part that has the shape of width x height.
PictureArea middle_of_shape(const Image& image, int width, int height) {
  const double shape = static_cast<double>(width) / height;
  const int part_width =
      std::clamp(static_cast<int>(std::lround(image.height * shape)), 1, image.width);
  const int part_height =
      std::clamp(static_cast<int>(std::lround(image.width / shape)), 1, image.height);
  return {(image.width - part_width) / 2, (image.height - part_height) / 2, part_width,
          part_height};
}

}  // namespace

Image scaled_to_fill(const Image& image, int width, int height) {
  if (image.width == width && image.height == height) return image;
  return image_library().scaled(image, middle_of_shape(image, width, height), width, height);
}

std::shared_ptr<const Image> load_background_image(const std::filesystem::path& path, int width,
                                                   int height, double gamma) {
  const bool is_linear = read_image_info(path).is_float;
  Image image = read_image(path);
  check_light(path, image);
  if (!is_linear) make_linear(image, gamma);
  return std::make_shared<const Image>(scaled_to_fill(image, width, height));
}

}  // namespace splotchcl
