#include "finish/adjust_light.h"

#include <algorithm>
#include <cmath>

#include "finish/tone.h"

namespace splotchcl {
namespace {

void expose(Image& image, double stops) {
  if (stops == 0) return;
  const auto factor = static_cast<float>(std::exp2(stops));
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    for (std::size_t c = 0; c < 3; ++c)
      image.pixels[i + c] *= factor;
  }
}

void saturate(Image& image, double saturation) {
  if (saturation == 1) return;
  const auto part = static_cast<float>(saturation);
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    float* const pixel = &image.pixels[i];
    // Rec. 709's weights.
    const float luminance = 0.2126F * pixel[0] + 0.7152F * pixel[1] + 0.0722F * pixel[2];
    for (int c = 0; c < 3; ++c)
      pixel[c] = std::max(0.0F, luminance + part * (pixel[c] - luminance));
  }
}

void change_contrast(Image& image, double contrast, double pivot) {
  if (contrast == 1) return;
  const auto exponent = static_cast<float>(contrast);
  const auto fixed = static_cast<float>(pivot);
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    for (std::size_t c = 0; c < 3; ++c) {
      float& value = image.pixels[i + c];
      value = fixed * std::pow(std::max(0.0F, value / fixed), exponent);
    }
  }
}

}  // namespace

void adjust_light(Image& image, const FinishSettings& finish, double gamma) {
  expose(image, finish.exposure.value());
  apply_tone(image, finish.tone, finish.white.value());
  saturate(image, finish.saturation);
  change_contrast(image, finish.contrast, std::pow(finish.contrast_pivot, gamma));
}

std::array<float, 3> light_of(const DisplayColor& color, double gamma) {
  std::array<float, 3> light;
  for (std::size_t c = 0; c < 3; ++c)
    light[c] = static_cast<float>(std::pow(color[c], gamma));
  return light;
}

}  // namespace splotchcl
