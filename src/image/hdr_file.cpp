#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <sstream>
#include <string>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#include <stb_image_write.h>

#include "image/picture_encoders.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr double most_light = 1.7e38;  // exponents have 8 bits

void append(void* bytes, void* data, int count) {
  const auto* const first = static_cast<const unsigned char*>(data);
  auto& file = *static_cast<std::vector<unsigned char>*>(bytes);
  file.insert(file.end(), first, first + count);
}

// To the nearest multiple of what the last bit of the pixel's shared exponent stands for. stb would
// cut off, and turn a value just below a power of two into 0.
void round_to_shared_exponent(float* color) {
  int exponent = 0;
  const float largest = std::max({color[0], color[1], color[2]});
  if (!(largest > 0)) return;
  if (std::frexp(largest, &exponent) > 255.5F / 256) ++exponent;
  const float step = std::ldexp(1.0F, exponent - 8);
  for (std::size_t c = 0; c < 3; ++c)
    color[c] = step * std::nearbyint(color[c] / step);
}

// Red, green and blue alone.
std::vector<float> colors_of(const std::filesystem::path& path, const Image& image) {
  const std::size_t pixels = image.pixels.size() / 4;
  std::vector<float> colors(3 * pixels);
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    for (std::size_t c = 0; c < 3; ++c) {
      const float light = image.pixels[4 * pixel + c];
      if (!(light >= 0 && static_cast<double>(light) <= most_light)) {
        const auto width = static_cast<std::size_t>(image.width);
        throw DataError(path.string() + ": the picture holds " + std::to_string(light) +
                        " at pixel " + std::to_string(pixel % width) + "," +
                        std::to_string(pixel / width) +
                        ", which .hdr cannot hold; an .exr file can");
      }
      colors[3 * pixel + c] = light;
    }
    round_to_shared_exponent(&colors[3 * pixel]);
  }
  return colors;
}

// Below the line that says what the file is.
void add_comments(const std::string& lines, std::vector<unsigned char>& file) {
  std::string comments;
  std::istringstream text(lines);
  for (std::string line; std::getline(text, line);)
    comments += "# " + line + "\n";
  const auto first_line = std::find(file.begin(), file.end(), '\n') + 1;
  file.insert(first_line, comments.begin(), comments.end());
}

}  // namespace

std::vector<unsigned char> encode_hdr(const std::filesystem::path& path, const Image& image,
                                      const std::string& description) {
  const std::vector<float> colors = colors_of(path, image);
  std::vector<unsigned char> file;
  if (stbi_write_hdr_to_func(append, &file, image.width, image.height, 3, colors.data()) == 0) {
    throw DataError(path.string() + ": " + std::to_string(image.width) + "x" +
                    std::to_string(image.height) + " pixels cannot be stored as .hdr");
  }
  add_comments(description, file);
  return file;
}

}  // namespace splotchcl
