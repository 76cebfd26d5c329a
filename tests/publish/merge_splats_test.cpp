#include "publish/light_splats.h"
#include "publish/web_page.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

std::vector<LightSplat> made_up_splats(std::size_t count) {
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  std::vector<LightSplat> splats(count);
  for (LightSplat& splat : splats) {
    splat.place = {10 * normal(random), normal(random), 3 + normal(random)};
    splat.sigma = std::exp(normal(random) - 2);
    splat.light = {std::exp(normal(random)), std::exp(2 * normal(random)), 0.5F};
  }
  return splats;
}

// Of all splats: light in each channel, its center, and its second moment.
struct Moments {
  double light[3] = {}, center[3] = {}, second = 0;
};

Moments moments_of(const std::vector<LightSplat>& splats) {
  Moments moments;
  double total = 0;
  for (const LightSplat& splat : splats) {
    const double area = std::pow(static_cast<double>(splat.sigma), 2);
    double flux = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      moments.light[c] += area * static_cast<double>(splat.light[c]);
      flux += area * static_cast<double>(splat.light[c]);
    }
    total += flux;
    moments.second += flux * 1.5 * area;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto x = static_cast<double>(splat.place[axis]);
      moments.center[axis] += flux * x;
      moments.second += flux * x * x;
    }
  }
  for (double& x : moments.center)
    x /= total;
  moments.second /= total;
  return moments;
}

TEST(MergedSplats, KeepLightAndItsCenterAndSecondMoment) {
  const std::vector<LightSplat> splats = made_up_splats(5000);
  const Moments all = moments_of(splats);
  for (const std::size_t most : {1000U, 50U, 1U}) {
    const std::vector<LightSplat> merged = merge_splats(splats, most);
    EXPECT_EQ(merged.size(), most);
    const Moments kept = moments_of(merged);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(kept.light[i], all.light[i], 1e-5 * all.light[i]);
      EXPECT_NEAR(kept.center[i], all.center[i], 1e-4);
    }
    EXPECT_NEAR(kept.second, all.second, 1e-4 * all.second);
  }
}

TEST(MergedSplats, AbsorbAsMuchAsTheirMembers) {
  std::vector<LightSplat> splats = made_up_splats(5000);
  for (LightSplat& splat : splats)
    splat.depth = {2 * splat.light[1], 0, splat.light[2]};
  const auto absorbed = [](const std::vector<LightSplat>& of, std::size_t channel) {
    double sum = 0;
    for (const LightSplat& splat : of)
      sum +=
          std::pow(static_cast<double>(splat.sigma), 2) * static_cast<double>(splat.depth[channel]);
    return sum;
  };
  const std::vector<LightSplat> merged = merge_splats(splats, 50);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const double all = absorbed(splats, channel);
    EXPECT_NEAR(absorbed(merged, channel), all, 1e-5 * all);
  }
}

TEST(MergedSplats, AreTheSplatsThemselvesWhereThereIsRoom) {
  const std::vector<LightSplat> splats = made_up_splats(100);
  const std::vector<LightSplat> merged = merge_splats(splats, 100);
  ASSERT_EQ(merged.size(), 100U);
  for (std::size_t i = 0; i < splats.size(); ++i)
    EXPECT_EQ(merged[i].place, splats[i].place);
}

TEST(MergedSplats, AreFewerWhereSplatsAreAlike) {
  std::vector<LightSplat> splats = made_up_splats(20);
  for (LightSplat& splat : splats) {
    splat.place = {1, 2, 3};
    splat.sigma = 0.1F;
  }
  EXPECT_EQ(merge_splats(splats, 10).size(), 1U);
  splats[4].sigma = 0.2F;
  EXPECT_GT(merge_splats(splats, 10).size(), 1U);
}

TEST(PackedSplats, AreNearTheSplats) {
  const std::vector<LightSplat> splats = made_up_splats(3000);
  const PackedSplats packed = pack(splats);
  const std::vector<LightSplat> unpacked = unpack(packed);
  ASSERT_EQ(unpacked.size(), splats.size());
  for (std::size_t i = 0; i < splats.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const float side = packed.upper[k] - packed.lower[k];
      EXPECT_NEAR(unpacked[i].place[k], splats[i].place[k], 0.51F / 65535 * side);
      // Half a step of 30 octaves.
      EXPECT_NEAR(unpacked[i].light[k] / splats[i].light[k], 1, 1.7e-4);
    }
    EXPECT_NEAR(unpacked[i].sigma / splats[i].sigma, 1, 2e-4);
  }
}

TEST(PackedSplats, KeepChannelsWithoutLightDark) {
  std::vector<LightSplat> splats = made_up_splats(2);
  splats[0].light = {1, 0, 1e-12F};
  const std::vector<LightSplat> unpacked = unpack(pack(splats));
  EXPECT_EQ(unpacked[0].light[1], 0.0F);
  EXPECT_EQ(unpacked[0].light[2], 0.0F);
}

TEST(PackedSplats, KeepDepthsOfAllChannelsOrOneThatIsAllOfThem) {
  std::vector<LightSplat> splats = made_up_splats(500);
  EXPECT_EQ(pack(splats).depths(), 0U);
  for (LightSplat& splat : splats)
    splat.depth.fill(splat.light[0]);
  splats[0].light = {0, 0, 0};
  EXPECT_EQ(pack(splats).depths(), 1U);
  for (const bool is_gray : {true, false}) {
    if (!is_gray) splats[1].depth[2] = 0;
    const PackedSplats packed = pack(splats);
    EXPECT_EQ(packed.depths(), is_gray ? 1U : 3U);
    const std::vector<LightSplat> unpacked = unpack(packed);
    for (std::size_t i = 0; i < splats.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(unpacked[i].depth[k], splats[i].depth[k], 1.7e-4F * splats[i].depth[k]);
    }
    EXPECT_EQ(unpacked[0].light[0], 0.0F);
  }
}

TEST(PackedSplats, OfNoneAreNone) {
  EXPECT_EQ(unpack(pack({})).size(), 0U);
}

}  // namespace
}  // namespace splotchcl::test
