// Very many faint layers in one pixel, against closed forms: a column of N layers, each
// with optical depth t and source s, is s (1 - exp(-N t)) / (1 - exp(-t)).
#include <cmath>

#include "hard_cases/hard_cases.h"
#include "hard_cases/hard_frames.h"

namespace splotchcl::test {
namespace {

// Their depths add up to 1.
constexpr std::size_t ten_million = 10000000, million = 1000000;

double depth_of_each(std::size_t count) {
  return 1 / static_cast<double>(count);
}

constexpr double grain_sigma = 0.3;

// X of a grain of weight 1 at the centre of its pixel: the mean over the pixel.
double grain_column() {
  const double axis = 0.5 * std::sqrt(pi) * grain_sigma * 2 * std::erf(0.5 / grain_sigma);
  return axis * axis;
}

// A picture of one pixel and so many grains at its centre.
Frame layers_in_one_pixel(std::size_t count, const Palette& palette) {
  DrawnComponent grains;
  grains.particles.count = count;
  std::vector<float> positions(3 * count, 0.0f);
  for (std::size_t i = 0; i < count; ++i) {
    positions[3 * i + 2] = 1;
  }
  grains.particles.position = Column::owning(std::move(positions));
  grains.particles.smoothing_length = Column::uniform(static_cast<float>(grain_sigma));
  grains.particles.weight = Column::uniform(1);
  // So that w X is the depth.
  const double column =
      1 / (pi * std::pow(static_cast<double>(static_cast<float>(grain_sigma)), 2));
  grains.reference_column = column * grain_column() / depth_of_each(count);
  grains.palette = palette;
  return frame_of(1, 1, {grains});
}

Frame equal_layers(std::size_t count, LightPlan plan) {
  Frame frame = layers_in_one_pixel(count, one_color(1, 1, 1));
  if (plan == LightPlan::ordered) {
    frame.components.front().palette.absorption = {Rgb{1, 1, 1}};
  } else {
    frame = lit(frame, plan);
  }
  return frame;
}

ReferenceImage equal_layers_exact(const Frame& frame) {
  const bool absorbs = frame.components.front().absorption.kind != Absorption::Kind::none;
  const double light = absorbs ? -std::expm1(-1.0) : 1.0;
  return even_picture(frame, light, light, light);
}

// Every second grain is dark; red: all depths alike, green: the dark ones absorb nothing,
// blue: the bright ones absorb nothing.
Frame alternating_layers(std::size_t count) {
  Palette palette;
  palette.emission = {Rgb{2, 2, 2}, Rgb{0, 0, 0}};
  palette.absorption = {Rgb{1, 1, 0}, Rgb{1, 0, 1}};
  Frame frame = layers_in_one_pixel(count, palette);
  std::vector<float> colors(count);
  for (std::size_t i = 0; i < count; ++i)
    colors[i] = static_cast<float>(i % 2);
  frame.components.front().particles.color = Column::owning(std::move(colors));
  return frame;
}

ReferenceImage alternating_layers_exact(const Frame& frame) {
  const std::size_t count = particle_count(frame);
  const double pairs = 0.5 * static_cast<double>(count);
  const double t = depth_of_each(count);
  // Sources of a bright layer with and without absorption, added up behind all before it.
  const double absorbing = -2 * std::expm1(-t), transparent = 2 * t;
  const double red = absorbing * std::expm1(-2 * pairs * t) / std::expm1(-2 * t);
  const double green = absorbing * std::expm1(-pairs * t) / std::expm1(-t);
  const double blue = transparent * std::expm1(-pairs * t) / std::expm1(-t);
  return even_picture(frame, red, green, blue);
}

}  // namespace

std::vector<HardCase> layer_cases() {
  // Their palette is black at its second color.
  constexpr bool colors_have_bound = false;
  const std::vector<LightPlan> all = HardCase{}.plans, ordered = {LightPlan::ordered};
  const auto equal = [](std::size_t count) {
    return [count](LightPlan plan) { return equal_layers(count, plan); };
  };
  const auto alternating = [](std::size_t count) {
    return [count](LightPlan) { return alternating_layers(count); };
  };
  return {
      {"TenMillionLayersInOnePixel",
       "a sum in single precision stalls: at 1 it no longer sees steps of 1e-8, and rounds "
       "steps of 1e-7 alike",
       equal(ten_million), all, equal_layers_exact, false, Drawn::never, Drawn::in_long_tests},
      {"MillionLayersInOnePixel", "a sum in single precision rounds steps of 1e-6 alike",
       equal(million), all, equal_layers_exact, false, Drawn::never},
      {"TenMillionAlternatingLayers",
       "bright and dark layers of 1e-7: source and opacity must both take every step",
       alternating(ten_million), ordered, alternating_layers_exact, false, Drawn::never,
       Drawn::in_long_tests, colors_have_bound, Drawn::in_long_tests},
      {"MillionAlternatingLayers", "the same with layers of 1e-6", alternating(million), ordered,
       alternating_layers_exact, false, Drawn::never, Drawn::always, colors_have_bound},
  };
}

}  // namespace splotchcl::test
