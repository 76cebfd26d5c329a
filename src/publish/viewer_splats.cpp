#include "publish/viewer_splats.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "finish/tone.h"

namespace splotchcl {
namespace {

double dot(const Vec3& axis, const std::array<float, 3>& place) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
    sum += axis.a[i] * static_cast<double>(place[i]);
  return sum;
}

float brightest(const LightSplat& splat) {
  return std::max({splat.light[0], splat.light[1], splat.light[2]});
}

// The display values of the splats' hues, as bright as can be. Light that is near white may have no
// hue any more: bright splats are shown as bright as they are.
Image shown_hues(const std::vector<LightSplat>& splats, double white, double least,
                 const DisplayLight& display) {
  Image image(static_cast<int>(splats.size()), 1);
  for (std::size_t i = 0; i < splats.size(); ++i) {
    const auto most = static_cast<double>(brightest(splats[i]));
    const double factor = white * std::clamp(most / white, least, 1.0) / most;
    for (std::size_t channel = 0; channel < 3; ++channel)
      image.pixels[4 * i + channel] =
          static_cast<float>(factor * static_cast<double>(splats[i].light[channel]));
  }
  image = displayed(std::move(image), display);
  for (std::size_t i = 0; i < splats.size(); ++i) {
    float* const color = &image.pixels[4 * i];
    const float most = std::max({color[0], color[1], color[2]});
    for (std::size_t channel = 0; most > 0 && channel < 3; ++channel)
      color[channel] /= most;
  }
  return image;
}

double unexposed_white(const FinishSettings& finish) {
  return finish.white.value_or(1) * std::exp2(-finish.exposure.value_or(0));
}

}  // namespace

Image displayed(Image light, const DisplayLight& display) {
  adjust_light(light, display.finish, display.gamma);
  for (float& value : light.pixels) {
    const float shown = std::clamp(value, 0.0F, 1.0F);
    value = static_cast<float>(std::pow(static_cast<double>(shown), 1 / display.gamma));
  }
  return light;
}

std::vector<ViewerSplat> viewer_splats(const std::vector<LightSplat>& splats, const Frame& frame,
                                       const DisplayLight& display, const LightToOpacity& opacity) {
  const CameraFrame& camera = frame.camera;
  const double white = unexposed_white(display.finish);
  const double per_length = camera.pixels_per_length / (0.5 * frame.width);
  const Image colors = shown_hues(splats, white, opacity.hue_at, display);
  std::vector<ViewerSplat> shown(splats.size());
  for (std::size_t i = 0; i < splats.size(); ++i) {
    const LightSplat& splat = splats[i];
    std::size_t axis = 0;
    for (const Vec3* const direction : {&camera.right, &camera.down, &camera.forward})
      shown[i].place[axis++] = static_cast<float>(per_length * dot(*direction, splat.place));
    // A profile's power is a wider or narrower Gaussian.
    shown[i].deviation = static_cast<float>(per_length * static_cast<double>(splat.sigma) /
                                            std::sqrt(2 * opacity.exponent));
    std::copy_n(&colors.pixels[4 * i], 3, shown[i].color.begin());
    const double light = opacity.gain * static_cast<double>(brightest(splat)) / white;
    shown[i].opacity = static_cast<float>(-std::expm1(-std::pow(light, opacity.exponent)));
  }
  return shown;
}

}  // namespace splotchcl
