// How bright a frame without absorption is guessed to be, before it is drawn.
#include "scene/plan/brightness_guess.h"

#include <gtest/gtest.h>

#include <vector>

#include "reference/frames.h"
#include "splotchcl/plan.h"

namespace splotchcl::test {
namespace {

constexpr int size = 96;  // cells of 4 pixels

// So many clouds in the picture's middle.
Frame crowd(std::size_t count, double peak, double sigma) {
  const std::vector<Cloud> clouds(count, {2, 2, 10, sigma, peak});
  DrawnComponent component = component_of(clouds, one_color(1, 0.5F, 0.2F));
  component.absorption = {Absorption::Kind::none, 0};
  return frame_of(size, size, {component});
}

TEST(BrightnessGuess, AddsUpWideClouds) {
  EXPECT_NEAR(guess_brightness(crowd(10, 0.5, 20)), 5, 1e-6);
}

TEST(BrightnessGuess, SpreadsNarrowCloudsOverACell) {
  const double sigma = 0.5, cell = 4;
  EXPECT_NEAR(guess_brightness(crowd(10, 2, sigma)), 20 * pi * sigma * sigma / (cell * cell), 1e-6);
}

TEST(BrightnessGuess, TakesEachSampledParticleForThoseLeftOut) {
  EXPECT_NEAR(guess_brightness(crowd(50000, 1e-3, 20)), 50, 1);
}

TEST(BrightnessGuess, LooksAtThePictureOnly) {
  Frame frame = crowd(10, 1, 2);
  frame.camera.center_x = -100;
  EXPECT_EQ(guess_brightness(frame), 0);
}

TEST(BrightnessGuess, DecidesHowFarSplatsAreDrawnAtFirst) {
  const SplatNeeds dim = make_plan(crowd(10, 0.01, 20)).needs;
  const SplatNeeds bright = make_plan(crowd(10, 10, 20)).needs;
  EXPECT_EQ(dim.grid_light, 1);
  EXPECT_GT(bright.grid_light, 100);
  EXPECT_GT(bright.widths[5].farther, dim.widths[5].farther + 3);
  EXPECT_EQ(bright.widths[0].farther, dim.widths[0].farther);
}

}  // namespace
}  // namespace splotchcl::test
