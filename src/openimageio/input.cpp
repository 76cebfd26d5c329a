#include "openimageio/input.h"

#include "splotchcl/error.h"

namespace splotchcl {

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
