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

#include "common/mapped_file.h"
#include "common/quiet_errors.h"
#include "common/unfinished_file.h"
#include "common/words.h"
#include "image/exr_header.h"
#include "image/image_library.h"
#include "image/picture_encoders.h"
#include "image/png_file.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using Metadata = std::map<std::string, std::string>;
using EncodeLight = std::vector<unsigned char>(const std::filesystem::path& path,
                                               const Image& image, const Metadata& metadata);

std::vector<unsigned char> encode_light_as_tiff(const std::filesystem::path& path,
                                                const Image& image, const Metadata&) {
  return encode_tiff(path, image);
}

std::vector<unsigned char> encode_light_as_hdr(const std::filesystem::path& path,
                                               const Image& image, const Metadata&) {
  return encode_hdr(path, image);
}

// A format that can be written, by the ending of a file's name.
struct Format {
  const char* ending;
  EncodeLight* encode_light = nullptr;  // linear floats; null: 8 bits
  int longest_side = std::numeric_limits<int>::max();
};

// Those that can be encoded in memory: writing the bytes is then ours to check.
// (On a full disk, and for a picture that is too large, libjpeg ends the whole program.)
constexpr std::array<Format, 13> formats = {{{"png"},
                                             {"jpg", nullptr, 65500},
                                             {"jpeg", nullptr, 65500},
                                             {"tga", nullptr, 65535},
                                             {"bmp"},
                                             {"ppm"},
                                             {"pnm"},
                                             {"webp", nullptr, 16383},
                                             {"jp2"},
                                             {"exr", encode_exr},
                                             {"tif", encode_light_as_tiff},
                                             {"tiff", encode_light_as_tiff},
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

std::uint8_t to_byte(float value, float exponent, bool truncates) {
  const float clamped = std::clamp(value, 0.0F, 1.0F);
  const float displayed = exponent == 1 ? clamped : std::pow(clamped, exponent);
  if (truncates) return static_cast<std::uint8_t>(std::min(256 * displayed, 255.0F));
  return static_cast<std::uint8_t>(255 * displayed + 0.5F);  // rounds, since it is positive
}

// The whole file, as bytes.
std::vector<unsigned char> encode(const std::filesystem::path& path, const Image& image,
                                  const ImageFileOptions& options) {
  const Format& format = format_of(path);
  if (format.encode_light != nullptr) return format.encode_light(path, image, options.metadata);
  const std::vector<std::uint8_t> bytes = display_bytes(path, image, options);
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

std::vector<std::uint8_t> display_bytes(const std::filesystem::path& path, const Image& image,
                                        const ImageFileOptions& options) {
  const std::size_t pixels = image.pixels.size() / 4;
  std::vector<std::uint8_t> bytes(3 * pixels);
  const auto exponent = static_cast<float>(1 / options.gamma);
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const float value = image.pixels[4 * pixel + channel];
      if (std::isnan(value)) {
        const auto width = static_cast<std::size_t>(image.width);
        throw DataError(path.string() + ": the picture is not a number at pixel " +
                        std::to_string(pixel % width) + "," + std::to_string(pixel / width) +
                        ", which 8 bits cannot hold; an .exr file can");
      }
      bytes[3 * pixel + channel] = to_byte(value, exponent, options.truncates);
    }
  }
  return bytes;
}

void write_image(const std::filesystem::path& path, const Image& image,
                 const ImageFileOptions& options) {
  check_image_size(path, image.width, image.height);
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

}  // namespace splotchcl
