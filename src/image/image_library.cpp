#include "image/image_library.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "modules/module_file.h"
#include "splotchcl/error.h"
#include "splotchcl/image_file.h"

namespace splotchcl {
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
