#include "pictures/units_of_white.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>

#include "finish/tone.h"
#include "pictures/error_growth.h"

namespace splotchcl {
namespace {

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

}  // namespace

namespace {

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
