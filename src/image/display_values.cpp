// What files of whole numbers store of light.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "image/blue_noise.h"
#include "parallel/for_blocks.h"
#include "splotchcl/error.h"
#include "splotchcl/image_file.h"

namespace splotchcl {
namespace {

// Where on the tile of blue noise a pixel lies.
class DitherPlaces {
 public:
  DitherPlaces(const PixelPlaces& places, const Image& image)
      : places_(places),
        width_(places.width > 0 ? places.width : std::max(1, image.width)),
        height_(places.height > 0 ? places.height : std::max(1, image.height)) {}

  // Of the pixels of a row, between 0 and 1, neither of which they are: whole numbers and their
  // roundings stay.
  void thresholds(std::size_t y, std::vector<float>& of_row) const {
    const std::uint16_t* ranks =
        blue_noise_ranks.data() + along(places_.top, y, height_) * blue_noise_side;
    for (std::size_t x = 0; x < of_row.size(); ++x) {
      const auto rank = static_cast<float>(ranks[along(places_.left, x, width_)]);
      of_row[x] = (rank + 0.5F) / static_cast<float>(blue_noise_ranks.size());
    }
  }

 private:
  static std::size_t along(int first, std::size_t place, int length) {
    return (static_cast<std::size_t>(first) + place % static_cast<std::size_t>(length)) %
           blue_noise_side;
  }

  PixelPlaces places_;
  int width_, height_;
};

[[noreturn]] void refuse_not_a_number(const std::filesystem::path& path, const Image& image,
                                      std::size_t pixel, int bits) {
  const auto width = static_cast<std::size_t>(image.width);
  throw DataError(path.string() + ": the picture is not a number at pixel " +
                  std::to_string(pixel % width) + "," + std::to_string(pixel / width) + ", which " +
                  std::to_string(bits) + " bits cannot hold; an .exr file can");
}

constexpr std::size_t rows_of_block = 16;

// The first pixel of those that threads find, in whatever order.
class FirstPixel {
 public:
  explicit FirstPixel(std::size_t none) : first_(none) {}
  void take(std::size_t pixel) {
    std::size_t first = first_;
    while (pixel < first && !first_.compare_exchange_weak(first, pixel)) {
    }
  }
  std::size_t get() const { return first_; }

 private:
  std::atomic<std::size_t> first_;
};

}  // namespace

std::vector<std::uint8_t> display_bytes(const std::filesystem::path& path, const Image& image,
                                        const ImageFileOptions& options) {
  const std::size_t pixels = image.pixels.size() / 4;
  std::vector<std::uint8_t> bytes(3 * pixels);
  const auto exponent = static_cast<float>(1 / options.gamma);
  const bool dithers = options.dithers && !options.truncates;
  const float scale = options.truncates ? 256 : 255;
  const DitherPlaces places(options.places, image);
  const auto width = static_cast<std::size_t>(image.width);
  const auto store = [&](std::size_t pixel, float added) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const float value = image.pixels[4 * pixel + channel];
      if (std::isnan(value)) return false;
      const float clamped = std::clamp(value, 0.0F, 1.0F);
      const float displayed = exponent == 1 ? clamped : std::pow(clamped, exponent);
      const float stored = std::min(scale * displayed + added, 255.0F);
      bytes[3 * pixel + channel] = static_cast<std::uint8_t>(stored);
    }
    return true;
  };
  FirstPixel refused(pixels);
  for_blocks(static_cast<std::size_t>(image.height), rows_of_block,
             [&](std::size_t first, std::size_t last) {
               std::vector<float> added(width, options.truncates ? 0.0F : 0.5F);
               for (std::size_t y = first; y < last; ++y) {
                 if (dithers) places.thresholds(y, added);
                 for (std::size_t x = 0; x < width; ++x) {
                   if (!store(y * width + x, added[x])) return refused.take(y * width + x);
                 }
               }
             });
  if (refused.get() < pixels) refuse_not_a_number(path, image, refused.get(), 8);
  return bytes;
}

std::vector<std::uint16_t> display_words(const std::filesystem::path& path, const Image& image,
                                         const ImageFileOptions& options) {
  const std::size_t pixels = image.pixels.size() / 4;
  std::vector<std::uint16_t> words(3 * pixels);
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const float value = image.pixels[4 * pixel + channel];
      if (std::isnan(value)) refuse_not_a_number(path, image, pixel, 16);
      // In double precision, since a float's last digit is a 256th of the last bit.
      const double clamped = std::clamp(static_cast<double>(value), 0.0, 1.0);
      const double displayed = options.gamma == 1 ? clamped : std::pow(clamped, 1 / options.gamma);
      words[3 * pixel + channel] = static_cast<std::uint16_t>(65535 * displayed + 0.5);
    }
  }
  return words;
}

}  // namespace splotchcl
