#include "image/png_file.h"

#include <png.h>

#include "splotchcl/error.h"

namespace splotchcl {

std::vector<unsigned char> encode_png(const std::filesystem::path& path, int width, int height,
                                      const std::vector<std::uint8_t>& rgb) {
  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGB;
  // The slow way takes four times as long for 7 % less.
  image.flags = PNG_IMAGE_FLAG_FAST;
  png_alloc_size_t bytes = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::vector<unsigned char> file(bytes);
  if (png_image_write_to_memory(&image, file.data(), &bytes, 0, rgb.data(), 0, nullptr) == 0) {
    throw DataError(path.string() + ": " + std::to_string(width) + "x" + std::to_string(height) +
                    " pixels cannot be stored as .png: " + image.message);
  }
  file.resize(bytes);
  return file;
}

}  // namespace splotchcl
