// How many clouds lie upon one another before something darker.
#include "scene/plan/crowding.h"

#include <gtest/gtest.h>

#include <vector>

#include "reference/frames.h"

namespace splotchcl::test {
namespace {

Frame frame_with(const std::vector<Cloud>& clouds) {
  return frame_of(200, 200, {component_of(clouds, one_color(1, 1, 1))});
}

TEST(Crowding, IsTheLightOfCloudsAtOnePoint) {
  const std::vector<Cloud> crowd(2000, Cloud{3.3, 5.1, 1, 4, 0.1});
  const double found = find_crowd(frame_with(crowd)).light;
  EXPECT_GE(found, 200 * (1 - 1e-6));
  EXPECT_LE(found, 4 * 200 * (1 + 1e-6));  // it may lie on the corner of four cells
}

TEST(Crowding, TellsTheWidthsOfTheClouds) {
  std::vector<Cloud> clouds(2000, Cloud{3.3, 5.1, 1, 4, 0.1});
  clouds.insert(clouds.end(), 10, Cloud{3.3, 5.1, 1, 40, 0.1});
  const Crowd crowd = find_crowd(frame_with(clouds));
  EXPECT_LT(crowd.narrowest_sigma, 4);
  EXPECT_GT(crowd.widest_sigma, 4);
  EXPECT_LT(crowd.widest_sigma, 8) << "clouds that do not crowd are drawn as ever";
}

TEST(Crowding, IsFoundInASample) {
  std::vector<Cloud> clouds;
  for (int i = 0; i < 100000; ++i) {
    const bool in_crowd = i % 20 == 0;
    clouds.push_back(in_crowd ? Cloud{3.3, 5.1, 1, 4, 0.1}
                              : Cloud{i * 7 % 181 - 90.0, i * 13 % 179 - 90.0, 1, 4, 1e-6});
  }
  EXPECT_GE(find_crowd(frame_with(clouds)).light, 500);
}

// However many there are: the ends of some fall on the middles of others.
TEST(Crowding, IsNoneInAnEvenField) {
  std::vector<Cloud> clouds;
  for (int y = -110; y <= 110; y += 2) {
    for (int x = -110; x <= 110; x += 2)
      clouds.push_back({x + 0.5, y + 0.5, 1, 5, 0.5});
  }
  EXPECT_EQ(find_crowd(frame_with(clouds)).light, 0);
}

TEST(Crowding, IsNoneWhereAllLightIsFaint) {
  EXPECT_EQ(find_crowd(frame_with(std::vector<Cloud>(2000, Cloud{3.3, 5.1, 1, 4, 1e-5}))).light, 0);
}

TEST(Crowding, IsNoneOutsideThePicture) {
  EXPECT_EQ(find_crowd(frame_with(std::vector<Cloud>(2000, Cloud{300, 5.1, 1, 4, 1}))).light, 0);
}

TEST(Crowding, IsNoneWithoutParticles) {
  EXPECT_EQ(find_crowd(frame_with({})).light, 0);
}

}  // namespace
}  // namespace splotchcl::test
