#include <cstddef>
#include <memory>
#include <vector>

#include "openimageio/input.h"
#include "openimageio/pictures.h"
#include "splotchcl/error.h"

namespace splotchcl {

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
