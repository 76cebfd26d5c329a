#include "scene/plan/guesses.h"

#include "reference/frames.h"
#include "splotchcl/plan.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

using Kind = Absorption::Kind;

// What an ordered frame is guessed to be like before it is drawn: how bright what lies behind
// layers is, how many wide splats lie over a pixel, and which part of the particles it shows.

// Gray clouds of this peak: E / A is peak / (peak + gray).
Frame gray_clouds(double peak, double gray) {
  std::vector<Cloud> clouds(100);
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    clouds[i].x = static_cast<double>(i % 10) - 5;
    clouds[i].y = static_cast<double>(i / 10) - 5;
    clouds[i].column = peak;
  }
  DrawnComponent component = component_of(clouds, one_color(1, 1, 1));
  component.absorption = {Kind::gray, gray};
  return frame_of(40, 30, {component});
}

double light_behind(const Frame& frame) {
  return make_plan(frame).light_behind;
}

TEST(LightBehind, IsThreeTimesTheSourceOfGrayClouds) {
  EXPECT_NEAR(light_behind(gray_clouds(0.1, 0.9)), 0.3, 1e-6);
}

TEST(LightBehind, IsNotBrighterThanWhite) {
  EXPECT_EQ(light_behind(gray_clouds(10, 0.1)), 1);
}

TEST(LightBehind, IsATenthAtLeastSoThatOpacityKeepsTenTimesTheTolerance) {
  EXPECT_EQ(light_behind(gray_clouds(1e-4, 1)), 0.1);
}

TEST(LightBehind, LeavesErrorsOfAbsorptionSmallAtLargeTolerances) {
  Frame frame = gray_clouds(1e-4, 1);
  frame.tolerance = 0.02;
  EXPECT_NEAR(light_behind(frame), 0.4, 1e-12);
}

TEST(LightBehind, IsNotBrighterThanWhiteAtAnyTolerance) {
  Frame frame = gray_clouds(1e-4, 1);
  frame.tolerance = 1;
  EXPECT_EQ(light_behind(frame), 1);
}

TEST(LightBehind, IsThatOfTheBackgroundWhereItIsBrighter) {
  Frame frame = gray_clouds(1e-4, 1);
  frame.background = {0.1, 0.7, 0.2};
  EXPECT_NEAR(light_behind(frame), 0.7, 1e-12);
}

TEST(LightBehind, IsWhiteWhereStarsOnlyEmit) {
  Frame frame = gray_clouds(1e-4, 1);
  frame.components.push_back(frame.components.front());
  frame.components.back().absorption = {Kind::none, 0};
  EXPECT_EQ(light_behind(frame), 1);
}

// To a single source an error of all layers does 1 / e of it.
TEST(LightBehind, DecidesHowFarTheSeriesOfLayersMayErr) {
  const double bright = make_plan(gray_clouds(10, 0.1)).layers.part;
  const double dim = make_plan(gray_clouds(1e-4, 1)).layers.part;
  EXPECT_NEAR(dim / bright, std::exp(-1) / (0.9 * 0.1), 1e-6);
}

TEST(LightBehind, IsTheSameForEveryCrop) {
  Frame frame = gray_clouds(0.1, 0.9);
  const double whole = light_behind(frame);
  frame.crop = {0, 0, 3, 2};
  EXPECT_EQ(light_behind(frame), whole);
}

TEST(LightBehind, CountsAbsorptionAsAWholeInExtendedPrecision) {
  Frame frame = gray_clouds(1e-4, 1);
  EXPECT_EQ(extend_plan(frame, make_plan(frame)).light_behind, 1);
  frame.tolerance = 0;
  EXPECT_EQ(light_behind(frame), 1);
}

// So many clouds of this sigma around a place, in pixels from the middle of a picture of 40 x 30.
Frame clouds_at(std::size_t count, double sigma, double x) {
  std::vector<Cloud> clouds(count);
  for (Cloud& cloud : clouds) {
    cloud.x = x;
    cloud.sigma = sigma;
    cloud.column = 0.1;
  }
  DrawnComponent component = component_of(clouds, one_color(1, 1, 1));
  component.absorption = {Kind::gray, 1};
  return frame_of(40, 30, {component});
}

TEST(WideLayers, AreAllCloudsWhereEachCoversThePicture) {
  EXPECT_NEAR(guess_order(clouds_at(70, 1000, 0)).wide_layers, 70, 1e-6);
}

TEST(WideLayers, CountThePixelsWithinThePictureOnly) {
  EXPECT_NEAR(guess_order(clouds_at(100, 8, 0)).wide_layers, 100, 1e-6) << "40 pixels across";
  EXPECT_NEAR(guess_order(clouds_at(100, 8, 20)).wide_layers, 50, 1) << "the left half of each";
  EXPECT_EQ(guess_order(clouds_at(100, 8, 500)).wide_layers, 0) << "beside the picture";
}

TEST(WideLayers, AreNoNarrowClouds) {
  EXPECT_EQ(guess_order(clouds_at(100, 3, 0)).wide_layers, 0);
}

TEST(VisiblePart, IsOfWhatTheCropShows) {
  Frame frame = clouds_at(100, 2, -15);
  frame.components.push_back(clouds_at(300, 2, 500).components.front());
  EXPECT_NEAR(guess_order(frame).visible_part, 0.25, 1e-12);
  frame.crop = {20, 0, 20, 30};
  EXPECT_EQ(guess_order(frame).visible_part, 0);
}

// How many splats could be stencils, from some of the particles, and what the plan makes of it.

constexpr int side = 64;

// So many clouds for each pixel of a picture, of this sigma, in its middle.
Frame clouds(double per_pixel, double sigma) {
  std::vector<Cloud> clouds(static_cast<std::size_t>(per_pixel * side * side));
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    clouds[i].x = static_cast<double>(i % 10) - 5;
    clouds[i].y = static_cast<double>(i / 10 % 10) - 5;
    clouds[i].sigma = sigma;
    clouds[i].column = 1e-4;
  }
  return frame_of(side, side, {component_of(clouds, one_color(1, 1, 1))});
}

Frame beside_the_picture(Frame frame) {
  std::vector<float> positions;
  const std::size_t count = frame.components.front().particles.count;
  for (std::size_t i = 0; i < count; ++i)
    positions.insert(positions.end(), {10.0F * side, 0, 10});
  frame.components.front().particles.position = Column::owning(positions);
  return frame;
}

TEST(WideSplats, AreThoseOfAnOctaveAndWiderOnes) {
  const WideSplats narrow = guess_wide_splats(clouds(2, 2), 2.2);
  EXPECT_EQ(narrow.of_one_octave, 0);
  EXPECT_EQ(narrow.wider, 0);
  const WideSplats wide = guess_wide_splats(clouds(2, 3), 2.2);
  EXPECT_NEAR(wide.of_one_octave, 2, 0.05);
  EXPECT_EQ(wide.wider, 0);
  const WideSplats wider = guess_wide_splats(clouds(2, 5), 2.2);
  EXPECT_EQ(wider.of_one_octave, 0);
  EXPECT_NEAR(wider.wider, 2, 0.05);
}

TEST(WideSplats, AreThoseOfThePicture) {
  EXPECT_EQ(guess_wide_splats(beside_the_picture(clouds(2, 3)), 2.2).of_one_octave, 0);
}

TEST(WideSplats, AreTheSameForACrop) {
  Frame frame = clouds(2, 3);
  const double whole = guess_wide_splats(frame, 2.2).of_one_octave;
  frame.crop = {50, 50, 8, 8};
  EXPECT_EQ(guess_wide_splats(frame, 2.2).of_one_octave, whole);
}

GridPyramid pyramid_of(const Frame& frame) {
  return make_plan(frame).pyramid;
}

TEST(PlanOfStencils, HasNoneOfFewOrNarrowSplats) {
  EXPECT_FALSE(pyramid_of(clouds(0.05, 6)).has_stencils());
  EXPECT_FALSE(pyramid_of(clouds(2, 2)).has_stencils());
}

TEST(PlanOfStencils, HasThemOnCoarseGrids) {
  const GridPyramid pyramid = pyramid_of(clouds(0.2, 6));
  ASSERT_TRUE(pyramid.has_stencils());
  EXPECT_EQ(pyramid.first_level, 1);
  EXPECT_EQ(pyramid.stencils.size(), 4U);
}

TEST(PlanOfStencils, HasThemOnGridsOfThePicturesPixelsForVeryMany) {
  const GridPyramid pyramid = pyramid_of(clouds(4, 3));
  ASSERT_TRUE(pyramid.has_stencils());
  EXPECT_EQ(pyramid.first_level, 0);
  EXPECT_EQ(pyramid.grids.at(4).level, 0);
  EXPECT_EQ(pyramid.grids.at(5).level, 1);
}

TEST(PlanOfStencils, HasNoneWhereTheyWouldErrByTooMuch) {
  Frame frame = clouds(4, 3);
  frame.tolerance = 1e-4;
  EXPECT_FALSE(pyramid_of(frame).has_stencils());
}

TEST(PlanOfStencils, HasNoneOfCutSplats) {
  Frame frame = clouds(4, 3);
  frame.kernel.cut = 1.8;
  frame.tolerance = 0.1;
  EXPECT_FALSE(pyramid_of(frame).has_stencils());
}

// How bright a frame without absorption is guessed to be, before it is drawn.

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
