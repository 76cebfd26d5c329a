// Clouds around the camera, found where they show.
#include "surroundings/clouds_in_blocks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "long_tests.h"
#include "scene/projection.h"
#include "surroundings/frames_around.h"

namespace splotchcl::test {
namespace {

std::vector<CloudAround> clouds_of(const Frame& frame, double farthest2) {
  std::vector<CloudAround> clouds;
  for (const DrawnComponent& component : frame.components) {
    for (std::size_t i = 0; i < component.particles.count; ++i) {
      clouds.push_back(cloud_around(component, frame, i));
      clouds.back().farthest2 = farthest2;
    }
  }
  return clouds;
}

TEST(CloudsInBlocks, AreAllThatShowInAPixel) {
  constexpr double wide_sigma = 16;
  std::size_t listed = 0, all = 0;
  for (const std::uint64_t seed : seeds(1, 60)) {
    const Frame frame = AroundSceneMaker(seed, 200).make();
    constexpr double farthest2 = 20;
    const std::vector<CloudAround> clouds = clouds_of(frame, farthest2);
    const CloudsInBlocks in_blocks(clouds, 0, clouds.size(), frame);
    for (int y = -70; y < frame.height + 70; y += 7) {
      for (int x = -70; x < frame.width + 70; x += 7) {
        const Vec3 direction = direction_at(x + 0.5, y + 0.5, frame.camera, frame.projection);
        const auto column = [&](std::size_t k) {
          return column_around(clouds[k], x, y, direction, frame.kernel, wide_sigma);
        };
        double of_all = 0, of_listed = 0;
        for (std::size_t k = 0; k < clouds.size(); ++k)
          of_all += column(k);
        for (const std::uint32_t k : in_blocks.at(x, y, 1))
          of_listed += column(k);
        ASSERT_NEAR(of_listed, of_all, static_cast<double>(clouds.size()) * std::exp(-farthest2))
            << "seed " << seed << ", pixel " << x << ", " << y;
        listed += in_blocks.at(x, y, 1).size();
        all += clouds.size();
      }
    }
  }
  EXPECT_LT(3 * listed, 2 * all) << "most clouds should be in some blocks only";
}

TEST(CloudsInBlocks, AreAllOfThemWherePixelsLieFarApart) {
  const Frame frame = AroundSceneMaker(7, 200).make();
  const std::vector<CloudAround> clouds = clouds_of(frame, 20);
  const CloudsInBlocks in_blocks(clouds, 3, clouds.size(), frame);
  EXPECT_EQ(in_blocks.at(0, 0, 64).size(), clouds.size() - 3);
  EXPECT_EQ(in_blocks.at(0, 0, 64).front(), 3u);
}

}  // namespace
}  // namespace splotchcl::test
