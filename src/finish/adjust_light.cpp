#include "finish/adjust_light.h"

#include <algorithm>
#include <cmath>

namespace splotchcl {
namespace {

void expose(float* pixel, float factor) {
  for (int c = 0; c < 3; ++c)
    pixel[c] *= factor;
}

void saturate(float* pixel, float saturation) {
  // Rec. 709's weights.
  const float luminance = 0.2126F * pixel[0] + 0.7152F * pixel[1] + 0.0722F * pixel[2];
  for (int c = 0; c < 3; ++c)
    pixel[c] = std::max(0.0F, luminance + saturation * (pixel[c] - luminance));
}

void change_contrast(float* pixel, float contrast, float pivot) {
  for (int c = 0; c < 3; ++c)
    pixel[c] = pivot * std::pow(std::max(0.0F, pixel[c] / pivot), contrast);
}

}  // namespace

void adjust_light(Image& image, const FinishSettings& finish, double gamma) {
  const bool has_exposure = finish.exposure != 0;
  const bool has_saturation = finish.saturation != 1;
  const bool has_contrast = finish.contrast != 1;
  if (!has_exposure && !has_saturation && !has_contrast) return;
  const auto factor = static_cast<float>(std::exp2(finish.exposure));
  const auto saturation = static_cast<float>(finish.saturation);
  const auto contrast = static_cast<float>(finish.contrast);
  const auto pivot = static_cast<float>(std::pow(finish.contrast_pivot, gamma));
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    float* pixel = &image.pixels[i];
    if (has_exposure) expose(pixel, factor);
    if (has_saturation) saturate(pixel, saturation);
    if (has_contrast) change_contrast(pixel, contrast, pivot);
  }
}

std::array<float, 3> light_of(const DisplayColor& color, double gamma) {
  std::array<float, 3> light;
  for (std::size_t c = 0; c < 3; ++c)
    light[c] = static_cast<float>(std::pow(color[c], gamma));
  return light;
}

}  // namespace splotchcl
