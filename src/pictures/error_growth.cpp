#include "pictures/error_growth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "finish/tone.h"
#include "splotchcl/image.h"

namespace splotchcl {
namespace {

using Color = std::array<double, 3>;

// Of the brightest channel, which is 1.
std::vector<Color> hues() {
  constexpr std::array<double, 4> parts = {0, 0.3, 0.7, 1};
  std::vector<Color> found;
  for (const double red : parts) {
    for (const double green : parts) {
      for (const double blue : parts) {
        if (std::max({red, green, blue}) == 1) found.push_back({red, green, blue});
      }
    }
  }
  return found;
}

// Of all hues, from dark light to what is brighter than white.
std::vector<Color> colors_up_to(double white) {
  constexpr double darkest = 1e-3, brightest = 2;  // of white
  constexpr int steps = 24;
  const std::vector<Color> all_hues = hues();
  std::vector<Color> found;
  for (int i = 0; i <= steps; ++i) {
    const double light =
        white * darkest * std::pow(brightest / darkest, static_cast<double>(i) / steps);
    for (const Color& hue : all_hues)
      found.push_back({light * hue[0], light * hue[1], light * hue[2]});
  }
  return found;
}

Image image_of(const std::vector<Color>& colors) {
  Image image(static_cast<int>(colors.size()), 1);
  for (std::size_t i = 0; i < colors.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c)
      image.pixels[4 * i + c] = static_cast<float>(colors[i][c]);
  }
  return image;
}

double brightest(const Image& image, std::size_t pixel) {
  const float* const channels = &image.pixels[4 * pixel];
  return static_cast<double>(std::max({channels[0], channels[1], channels[2]}));
}

// Before saturation and contrast, too, where no curve has ended at white.
std::vector<double> units_of(const Image& drawn, const Image& shown, FinishSettings finish,
                             double gamma) {
  Image toned = drawn;
  finish.saturation = finish.contrast = 1;
  adjust_light(toned, finish, gamma);
  std::vector<double> units;
  for (std::size_t i = 0; 4 * i < shown.pixels.size(); ++i)
    units.push_back(std::max({1.0, brightest(toned, i), brightest(shown, i)}));
  return units;
}

constexpr double part = 1e-3;  // of light that errors are

// A bit of `signs` for each channel: whether it errs downwards.
std::vector<Color> with_errors(std::vector<Color> colors, unsigned signs, double gain) {
  for (Color& color : colors) {
    for (unsigned c = 0; c < 3; ++c) {
      const double error = part * std::max(1 / gain, color[c]);
      color[c] = std::max(0.0, color[c] + ((signs >> c & 1U) != 0 ? -error : error));
    }
  }
  return colors;
}

double largest_growth(const Image& shown, const Image& other, const std::vector<double>& units) {
  double worst = 0;
  for (std::size_t i = 0; i < shown.pixels.size(); ++i) {
    const double error = std::abs(static_cast<double>(shown.pixels[i] - other.pixels[i]));
    worst = std::max(worst, error / (part * units[i / 4]));
  }
  return worst;
}

// Of light alone: every channel by itself.
bool mixes_nothing(const FinishSettings& finish) {
  return finish.tone == ToneCurve::linear && finish.highlights == 0 && !finish.white_balance &&
         finish.saturation == 1 && finish.contrast == 1;
}

double growth_of(const std::vector<Color>& colors, const FinishSettings& finish, double gamma,
                 double gain) {
  const Image drawn = image_of(colors);
  Image shown = drawn;
  adjust_light(shown, finish, gamma);
  const std::vector<double> units = units_of(drawn, shown, finish, gamma);
  double growth = 0;
  // The other four sign patterns are these upside down.
  for (unsigned signs = 0; signs < 4; ++signs) {
    Image other = image_of(with_errors(colors, signs, gain));
    adjust_light(other, finish, gamma);
    growth = std::max(growth, largest_growth(shown, other, units));
  }
  return growth;
}

std::vector<Color> some_colors(const Image& light) {
  constexpr std::size_t most = 131072;
  const std::size_t pixels = light.pixels.size() / 4;
  const std::size_t stride = (pixels + most - 1) / most;
  std::vector<Color> found;
  for (std::size_t i = 0; i < pixels; i += stride) {
    Color color{};
    for (std::size_t c = 0; c < 3; ++c)
      color[c] = static_cast<double>(light.pixels[4 * i + c]);
    found.push_back(color);
  }
  return found;
}

}  // namespace

double error_growth(FinishSettings finish, double gamma, double gain) {
  finish.contrast = std::max(1.0, finish.contrast);
  if (mixes_nothing(finish)) return 1;
  const double white = finish.white.value() * std::exp2(-finish.exposure.value());
  return growth_of(colors_up_to(white), finish, gamma, gain);
}

double error_growth(const Image& light, FinishSettings finish, double gamma, double gain) {
  finish.contrast = std::max(1.0, finish.contrast);
  if (mixes_nothing(finish)) return 1;
  return growth_of(some_colors(light), finish, gamma, gain);
}

}  // namespace splotchcl
