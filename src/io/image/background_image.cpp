#include "io/image/background_image.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "splotchcl/error.h"
#include "splotchcl/image_file.h"

namespace splotchcl {
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

OIIO::ImageBuf wrap(Image& image) {
  return OIIO::ImageBuf(OIIO::ImageSpec(image.width, image.height, 4, OIIO::TypeDesc::FLOAT),
                        image.pixels.data());
}

// The middle part that has the shape of width x height.
OIIO::ROI middle_of_shape(const Image& image, int width, int height) {
  const double shape = static_cast<double>(width) / height;
  const int part_width =
      std::clamp(static_cast<int>(std::lround(image.height * shape)), 1, image.width);
  const int part_height =
      std::clamp(static_cast<int>(std::lround(image.width / shape)), 1, image.height);
  const int x = (image.width - part_width) / 2, y = (image.height - part_height) / 2;
  return {x, x + part_width, y, y + part_height};
}

}  // namespace

Image scaled_to_fill(const Image& image, int width, int height) {
  if (image.width == width && image.height == height) return image;
  Image pixels = image;
  const OIIO::ImageBuf source =
      OIIO::ImageBufAlgo::cut(wrap(pixels), middle_of_shape(image, width, height));
  Image result(width, height);
  OIIO::ImageBuf target = wrap(result);
  // A filter without negative weights: light stays >= 0.
  OIIO::ImageBufAlgo::resize(target, source, "blackman-harris");
  return result;
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
