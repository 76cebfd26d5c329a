#include "scene/plan/tried_parts.h"

#include "testing.h"

namespace splotchcl::test {
namespace {

Frame frame_of_size(int width, int height) {
  Frame frame;
  frame.width = width;
  frame.height = height;
  return frame;
}

SampledCloud cloud_at(double x, double y, double sigma, double light) {
  SampledCloud cloud;
  cloud.x = x;
  cloud.y = y;
  cloud.sigma = sigma;
  cloud.light = light;
  return cloud;
}

bool shows(const Rectangle& part, double x, double y) {
  return x >= part.x && x < part.x + part.width && y >= part.y && y < part.y + part.height;
}

TEST(LightMap, AddsUpWhatLiesInACell) {
  const std::vector<SampledCloud> clouds(5, cloud_at(100, 60, 20, 0.3));
  EXPECT_NEAR(LightMap(clouds, frame_of_size(200, 150)).brightest(), 1.5, 1e-9);
}

TEST(LightMap, SpreadsNarrowCloudsOverTheirCell) {
  const std::vector<SampledCloud> stars = {cloud_at(100, 60, 0.1, 256)};
  EXPECT_NEAR(LightMap(stars, frame_of_size(200, 150)).brightest(), 1, 1e-9);
}

TEST(LightMap, TakesNothingFromAFewCloudsOfASample) {
  std::vector<SampledCloud> clouds(3, cloud_at(100, 60, 20, 1));
  for (SampledCloud& cloud : clouds)
    cloud.weight = 100;
  EXPECT_EQ(LightMap(clouds, frame_of_size(200, 150)).brightest(), 0);
  clouds.push_back(clouds.front());
  EXPECT_NEAR(LightMap(clouds, frame_of_size(200, 150)).brightest(), 400, 1e-9);
}

TEST(LightMap, LeavesOutWhatLiesBesideThePicture) {
  const std::vector<SampledCloud> clouds(5, cloud_at(-20, 60, 20, 0.3));
  EXPECT_EQ(LightMap(clouds, frame_of_size(200, 150)).brightest(), 0);
}

TEST(LightMap, KnowsWhetherAQuarterOfThePictureIsBright) {
  std::vector<SampledCloud> clouds;
  for (int row = 0; row < 3; ++row)
    clouds.push_back(cloud_at(8, 16 * row + 8, 20, 1));
  const Frame frame = frame_of_size(160, 16);
  EXPECT_EQ(LightMap(clouds, frame).of_bright_quarter(), 0);
  for (int column = 0; column < 4; ++column)
    clouds.push_back(cloud_at(16 * column + 8, 8, 20, 1));
  EXPECT_GE(LightMap(clouds, frame).of_bright_quarter(), 1);
}

TEST(TellingParts, ShowTheBrightestTheMostUnevenAndTheBrightestAtTheEdge) {
  const std::vector<SampledCloud> clouds = {cloud_at(300, 200, 40, 50), cloud_at(100, 200, 2, 8),
                                            cloud_at(420, 500, 40, 3)};
  const Frame frame = frame_of_size(600, 400);
  const std::vector<Rectangle> parts = LightMap(clouds, frame).telling_parts(LightPlan::ordered);
  ASSERT_EQ(parts.size(), 3U);
  EXPECT_TRUE(shows(parts[0], 300, 200));
  EXPECT_TRUE(shows(parts[1], 100, 200));
  EXPECT_TRUE(shows(parts[2], 420, 399));
}

// Where light is deep, or adds up without end, errors of a crowd do not show as those beside it do.
TEST(TellingParts, AreNotWhereLightHidesErrors) {
  std::vector<SampledCloud> clouds(4, cloud_at(104, 200, 20, 50));
  clouds.push_back(cloud_at(400, 200, 20, 3));
  const Frame frame = frame_of_size(600, 400);
  for (const LightPlan light : {LightPlan::emission, LightPlan::proportional}) {
    const Rectangle part = LightMap(clouds, frame).telling_parts(light).front();
    EXPECT_TRUE(shows(part, 104, 200)) << "what is near is drawn";
    EXPECT_FALSE(part.x + 32 <= 104 && 104 < part.x + 48) << "but not in the middle";
  }
}

TEST(TellingParts, AreOneWhereAllIsInOnePlace) {
  const std::vector<SampledCloud> clouds = {cloud_at(300, 399, 5, 50)};
  EXPECT_EQ(LightMap(clouds, frame_of_size(600, 400)).telling_parts(LightPlan::ordered).size(), 1U);
}

TEST(TellingParts, AreNoneOfADarkPicture) {
  EXPECT_TRUE(LightMap({}, frame_of_size(600, 400)).telling_parts(LightPlan::ordered).empty());
}

}  // namespace
}  // namespace splotchcl::test
