#include "finish/fade.h"

#include "finish/adjust_light.h"

namespace splotchcl {

void mix(Image& image, const Image& other, double amount) {
  const auto part = static_cast<float>(amount);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = (1 - part) * image.pixels[i] + part * other.pixels[i];
}

void fade_to_color(Image& image, const FinishSettings& finish, double gamma) {
  if (finish.fade == 0) return;
  const auto part = static_cast<float>(finish.fade);
  const std::array<float, 3> light = light_of(finish.fade_color, gamma);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const float target = i % 4 == 3 ? 1 : light[i % 4];
    image.pixels[i] = (1 - part) * image.pixels[i] + part * target;
  }
}

}  // namespace splotchcl
