#pragma once

#include <cstddef>
#include <vector>

namespace splotchcl {

// Linear light, row 0 at the top, four floats per pixel: red, green, blue (1 is the
// display's white, larger values are kept) and alpha, the opacity 1 - exp(-tau)
// averaged over the channels, to ten times the frame's tolerance. Colour is premultiplied: emission
// needs no opacity.
struct Image {
  int width = 0, height = 0;
  std::vector<float> pixels;  // 4 * width * height

  Image() = default;
  Image(int width_pixels, int height_pixels)
      : width(width_pixels),
        height(height_pixels),
        pixels(4 * static_cast<std::size_t>(width_pixels) *
               static_cast<std::size_t>(height_pixels)) {}
  // The four floats of a pixel, 0 <= x < width, 0 <= y < height.
  float* at(int x, int y) { return pixels.data() + offset(x, y); }
  const float* at(int x, int y) const { return pixels.data() + offset(x, y); }

 private:
  std::size_t offset(int x, int y) const {
    return 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(x));
  }
};

// The same in double precision, as the reference renderer draws it.
struct ReferenceImage {
  int width = 0, height = 0;
  std::vector<double> pixels;  // 4 * width * height

  ReferenceImage() = default;
  ReferenceImage(int width_pixels, int height_pixels)
      : width(width_pixels),
        height(height_pixels),
        pixels(4 * static_cast<std::size_t>(width_pixels) *
               static_cast<std::size_t>(height_pixels)) {}
  // Every value rounded to the nearest float.
  Image to_float() const {
    Image image(width, height);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      image.pixels[i] = static_cast<float>(pixels[i]);
    }
    return image;
  }
};

}  // namespace splotchcl
