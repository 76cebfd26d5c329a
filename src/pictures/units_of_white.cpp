#include "pictures/units_of_white.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include "finish/tone.h"
#include "splotchcl/finish.h"
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

// By how much relative errors of light grow where it is finished: by exposure, balance of white,
// tone, highlights, saturation and contrast. A channel errs by a part of its light or of 1 /
// `gain`, whichever is more, and what is shown counts in units of white or of its pixel's brightest
// channel. Found by finishing colors of all kinds with errors of all signs. A contrast below 1,
// which is infinitely steep in the dark, counts as 1. Exposure and white are known.
double error_growth(FinishSettings finish, double gamma, double gain) {
  finish.contrast = std::max(1.0, finish.contrast);
  if (mixes_nothing(finish)) return 1;
  const double white = finish.white.value() * std::exp2(-finish.exposure.value());
  return growth_of(colors_up_to(white), finish, gamma, gain);
}

// The same of a picture's own colors, of which some hundred thousand are finished.
double error_growth(const Image& light, FinishSettings finish, double gamma, double gain) {
  finish.contrast = std::max(1.0, finish.contrast);
  if (mixes_nothing(finish)) return 1;
  return growth_of(some_colors(light), finish, gamma, gain);
}

constexpr double largest_gain = 1073741824;  // 2^30
constexpr double least_gain = 1e-3, least_growth = 0.1;
constexpr double largest_tolerance = 1;
constexpr double most_light = 1e30;  // in single precision, with room for sums

void multiply_light(Image& image, double factor) {
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (i % 4 != 3) image.pixels[i] *= static_cast<float>(factor);
  }
}

double brightest_part(const Frame& frame) {
  double brightest = *std::max_element(frame.background.begin(), frame.background.end());
  for (const DrawnComponent& component : frame.components)
    brightest = std::max(brightest, component.brightness);
  return brightest;
}

// The power of two that counts errors almost often enough; a finer tolerance does the rest.
double power_for(const Frame& frame, double gain) {
  double factor = std::exp2(std::floor(std::log2(gain)));
  while (factor > 1 && factor * brightest_part(frame) > most_light)
    factor /= 2;
  return factor;
}

// How such a component's light follows from its brightness is no line.
bool has_gray_absorption(const Frame& frame) {
  return std::any_of(frame.components.begin(), frame.components.end(),
                     [](const DrawnComponent& component) {
                       return component.absorption.kind == Absorption::Kind::gray;
                     });
}

void brighten(DrawnComponent& component, double factor) {
  Absorption& absorption = component.absorption;
  if (component.brightness == 0 || factor == 1) return;
  if (absorption.kind == Absorption::Kind::as_emission)
    absorption = {Absorption::Kind::factor, component.brightness};
  component.brightness *= factor;
}

Frame brighter(Frame frame, double factor) {
  for (DrawnComponent& component : frame.components)
    brighten(component, factor);
  for (double& light : frame.background)
    light *= factor;
  if (frame.background_image) {
    const auto image = std::make_shared<Image>(*frame.background_image);
    multiply_light(*image, factor);
    frame.background_image = image;
  }
  return frame;
}

double gain_of_light(const FinishSettings& finish, double least) {
  const double slope = steepest_slope(finish.tone, finish.white.value());
  return std::clamp(std::exp2(*finish.exposure) * slope, least, largest_gain);
}

}  // namespace

DisplayGain display_gain(const FinishSettings& finish, double gamma) {
  DisplayGain gain;
  gain.of_light = gain_of_light(finish, 1);
  gain.of_errors = std::max(1.0, error_growth(finish, gamma, gain.of_light));
  return gain;
}

DisplayGain display_gain_of_shown(const Image& light, const FinishSettings& finish, double gamma) {
  DisplayGain gain;
  gain.of_light = gain_of_light(finish, least_gain);
  gain.of_errors = std::max(least_growth, error_growth(light, finish, gamma, gain.of_light));
  return gain;
}

bool keeps_promise_at(double gain, double estimated_error_of_promise) {
  constexpr double margin = 4;
  return margin * gain * estimated_error_of_promise <= 1;
}

DrawFrame with_errors_counted(const DrawFrame& draw, const DisplayGain& gain) {
  if (gain.total() == 1) return draw;
  return [draw, gain](const Frame& frame) {
    if (frame.tolerance == 0) return draw(frame);  // it is as exact as it can be
    const double factor = has_gray_absorption(frame) ? 1 : power_for(frame, gain.of_light);
    Frame counted = brighter(frame, factor);
    counted.tolerance = std::min(largest_tolerance, frame.tolerance * factor / gain.total());
    Image image = draw(counted);
    multiply_light(image, 1 / factor);
    return image;
  };
}

}  // namespace splotchcl
