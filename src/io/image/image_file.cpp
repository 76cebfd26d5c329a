#include "splotchcl/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "io/common/unfinished_file.h"
#include "io/image/image_input.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// A format that can be written, by the ending of a file's name.
struct Format {
  const char* ending;
  bool is_float;   // linear 32-bit floats; otherwise 8 bits
  bool has_alpha;  // written with premultiplied alpha
  int longest_side = std::numeric_limits<int>::max();
};

// Those that OpenImageIO can encode in memory: writing the bytes is then ours to check.
// (On a full disk, and for a picture that is too large, libjpeg ends the whole program.)
constexpr std::array<Format, 13> formats = {{{"png", false, false},
                                             {"jpg", false, false, 65500},
                                             {"jpeg", false, false, 65500},
                                             {"tga", false, false, 65535},
                                             {"bmp", false, false},
                                             {"ppm", false, false},
                                             {"pnm", false, false},
                                             {"webp", false, false, 16383},
                                             {"jp2", false, false},
                                             {"exr", true, true},
                                             {"tif", true, true},
                                             {"tiff", true, true},
                                             {"hdr", true, false}}};

std::string endings() {
  std::string list;
  for (const Format& format : formats)
    list += std::string(list.empty() ? "." : ", .") + format.ending;
  return list;
}

const Format& format_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
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

std::vector<std::uint8_t> to_bytes(const std::filesystem::path& path, const Image& image,
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

OIIO::ImageSpec make_spec(const Image& image, const Format& format, const OIIO::ImageOutput& output,
                          const ImageFileOptions& options) {
  OIIO::ImageSpec spec(image.width, image.height, format.has_alpha ? 4 : 3,
                       format.is_float ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
  // PNG: the default level takes four times as long for 7 % less.
  spec.attribute("png:compressionLevel", 4);
  // JPEG: little loss, and none of it by halving the resolution of colour.
  spec.attribute("CompressionQuality", 95);
  spec.attribute("jpeg:subsampling", "4:4:4");
  if (output.supports("arbitrary_metadata")) {
    for (const auto& [name, text] : options.metadata)
      spec.attribute(name, text);
  }
  return spec;
}

// The whole file, as bytes.
std::vector<unsigned char> encode(const std::filesystem::path& path, const Image& image,
                                  const ImageFileOptions& options) {
  const Format& format = format_of(path);
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format.ending);
  if (!output || !output->supports("ioproxy")) {
    (void)OIIO::geterror();
    throw UsageError(path.string() + ": this build of OpenImageIO cannot write ." + format.ending +
                     "; choose another ending, such as .png or .exr");
  }
  const auto require = [&](bool good) {
    if (good) return;
    throw DataError(path.string() + ": " + std::to_string(image.width) + "x" +
                    std::to_string(image.height) + " pixels cannot be stored as ." + format.ending +
                    ": " + first_line(output->geterror()));
  };
  const std::vector<std::uint8_t> bytes =
      format.is_float ? std::vector<std::uint8_t>() : to_bytes(path, image, options);
  std::vector<unsigned char> file;
  OIIO::Filesystem::IOVecOutput memory(file);
  require(output->set_ioproxy(&memory));
  require(output->open(std::string("picture.") + format.ending,
                       make_spec(image, format, *output, options)));
  if (format.is_float) {
    require(output->write_image(OIIO::TypeDesc::FLOAT, image.pixels.data(), 4 * sizeof(float)));
  } else {
    require(output->write_image(OIIO::TypeDesc::UINT8, bytes.data()));
  }
  require(output->close());
  return file;
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

void write_image(const std::filesystem::path& path, const Image& image,
                 const ImageFileOptions& options) {
  check_image_size(path, image.width, image.height);
  const std::vector<unsigned char> bytes = encode(path, image, options);
  UnfinishedFile file(path);
  file.write(bytes.data(), bytes.size());
  file.finish();
}

Image read_image(const std::filesystem::path& path) {
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

ImageFileInfo read_image_info(const std::filesystem::path& path) {
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
