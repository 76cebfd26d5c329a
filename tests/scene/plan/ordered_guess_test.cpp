// What an ordered frame is guessed to be like before it is drawn: how bright what lies behind
// layers is, how many wide splats lie over a pixel, and which part of the particles it shows.
#include "scene/plan/ordered_guess.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "reference/frames.h"
#include "splotchcl/plan.h"

namespace splotchcl::test {
namespace {

using Kind = Absorption::Kind;

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

}  // namespace
}  // namespace splotchcl::test
