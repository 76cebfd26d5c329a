#include "pictures/units_of_white.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>

#include "finish/tone.h"

namespace splotchcl {
namespace {

constexpr double largest_gain = 1073741824;  // 2^30
constexpr double most_light = 1e30;          // in single precision, with room for sums

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

// Of a channel whose error has another sign than the luminance's.
double slope_of_saturation(const FinishSettings& finish) {
  return std::max(1.0, 2 * finish.saturation - 1);
}

// At white, where it is steepest.
double slope_of_contrast(const FinishSettings& finish, double gamma) {
  const double pivot = std::pow(finish.contrast_pivot, gamma);
  return std::max(1.0, finish.contrast * std::pow(1 / pivot, finish.contrast - 1));
}

}  // namespace

double display_gain(const FinishSettings& finish, double gamma) {
  // What changes a pixel's brightest channel changes the others with it, a little more than a
  // curve that bends would by itself.
  const double bent = finish.tone == ToneCurve::linear ? 1 : 1.1;
  const double slope = bent * steepest_slope(finish.tone, finish.white.value());
  const double of_light = std::exp2(*finish.exposure) * slope * slope_of_saturation(finish) *
                          slope_of_contrast(finish, gamma);
  return std::clamp(of_light, 1.0, largest_gain);
}

DrawFrame with_errors_counted(const DrawFrame& draw, double gain) {
  if (!(gain > 1)) return draw;
  return [draw, gain](const Frame& frame) {
    if (frame.tolerance == 0) return draw(frame);  // it is as exact as it can be
    const double factor = has_gray_absorption(frame) ? 1 : power_for(frame, gain);
    Frame counted = brighter(frame, factor);
    counted.tolerance *= factor / gain;
    Image image = draw(counted);
    multiply_light(image, 1 / factor);
    return image;
  };
}

}  // namespace splotchcl
