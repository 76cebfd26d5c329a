// Splats of large ordered frames lie in parts of their sort keys: which parts there are, and that
// nothing of a picture depends on them.
#include "device/frame/key_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "device/cloud_frames.h"
#include "device/pictures.h"
#include "device/scene_maker.h"
#include "device/stages.h"

namespace splotchcl::test {
namespace {

using SampledKeys = std::vector<std::uint64_t>;

DeviceTraits traits_of_parts(std::uint32_t splats_of_part, std::uint32_t fewest_parts) {
  DeviceTraits traits;
  traits.splats_of_part = splats_of_part;
  traits.fewest_parts = fewest_parts;
  return traits;
}

// `count` keys, `upper_step` apart in their upper 32 bits.
SampledKeys even_keys(std::size_t count, std::uint64_t upper_step) {
  SampledKeys keys;
  for (std::size_t i = 0; i < count; ++i)
    keys.push_back((0x40000000 + i * upper_step) << 16);
  return keys;
}

// The part of a key, as kernels find it.
std::size_t part_of(std::uint64_t key, const KeyParts& parts) {
  const auto upper = static_cast<std::uint32_t>(key >> 16);
  const std::uint32_t above = std::max(upper, parts.first_key) - parts.first_key;
  return parts.part_of_bin[std::min<std::uint32_t>(above >> parts.shift, KEY_PART_BINS - 1)];
}

TEST(KeyParts, HaveAboutAsManySplatsEach) {
  const SampledKeys keys = even_keys(2000, 12345);
  const auto parts = choose_key_parts(keys, 1e6, traits_of_parts(10000, 8));
  ASSERT_TRUE(parts);
  EXPECT_NEAR(static_cast<double>(parts->parts.size()), 100, 3);
  std::vector<int> sampled(parts->parts.size());
  for (const std::uint64_t key : keys)
    ++sampled[part_of(key, *parts)];
  EXPECT_LE(*std::max_element(sampled.begin(), sampled.end()), 30);
}

TEST(KeyParts, AscendAndLeaveNoKeyBetweenThem) {
  const SampledKeys keys = even_keys(2000, 777777);
  const auto parts = choose_key_parts(keys, 1e6, traits_of_parts(10000, 8));
  ASSERT_TRUE(parts);
  ASSERT_EQ(parts->part_of_bin.size(), std::size_t{KEY_PART_BINS});
  EXPECT_TRUE(std::is_sorted(parts->part_of_bin.begin(), parts->part_of_bin.end()));
  for (std::size_t p = 0; p < parts->parts.size(); ++p) {
    EXPECT_LT(parts->parts[p].first, parts->parts[p].end) << p;
    if (p > 0) {
      EXPECT_EQ(parts->parts[p].first, parts->parts[p - 1].end) << p;
    }
  }
  EXPECT_EQ(parts->parts.front().first, keys.front() >> 16);
  EXPECT_EQ(parts->parts.back().end, (keys.back() >> 16) + 1);
}

TEST(KeyParts, HoldTheKeysOfTheirBins) {
  const SampledKeys keys = even_keys(2000, 4321);
  const auto parts = choose_key_parts(keys, 1e6, traits_of_parts(10000, 8));
  ASSERT_TRUE(parts);
  for (const std::uint64_t key : keys) {
    const KeyPart& part = parts->parts[part_of(key, *parts)];
    EXPECT_GE(key >> 16, part.first);
    EXPECT_LT(key >> 16, part.end);
  }
}

// One cloud far behind all others does not leave these in a few bins.
TEST(KeyParts, DoNotWidenForAFewKeysFarOff) {
  SampledKeys keys = even_keys(2000, 10);
  keys.back() = std::uint64_t{0xfffffff0} << 16;
  const auto parts = choose_key_parts(keys, 1e6, traits_of_parts(10000, 8));
  ASSERT_TRUE(parts);
  EXPECT_GT(parts->parts.size(), 90u);
}

TEST(KeyParts, AreNoneOfSmallFrames) {
  EXPECT_FALSE(choose_key_parts(even_keys(2000, 1000), 319999, traits_of_parts(10000, 32)));
  EXPECT_TRUE(choose_key_parts(even_keys(2000, 1000), 320000, traits_of_parts(10000, 32)));
}

TEST(KeyParts, AreNoneOfTooFewSampledKeys) {
  EXPECT_FALSE(choose_key_parts({}, 1e6, traits_of_parts(10000, 8)));
  EXPECT_FALSE(choose_key_parts(even_keys(31, 1000), 1e6, traits_of_parts(10000, 8)));
}

// A thread would sort them all.
TEST(KeyParts, AreNoneWhereManyKeysAreEqual) {
  EXPECT_FALSE(choose_key_parts(even_keys(2000, 0), 1e6, traits_of_parts(10000, 8)));
  SampledKeys keys = even_keys(2000, 1000);
  std::fill(keys.begin(), keys.begin() + 200, keys[200]);
  EXPECT_FALSE(choose_key_parts(keys, 1e6, traits_of_parts(10000, 8)));
}

// Small frames in many parts, of ranges of blocks that components do not fill.
class InParts : public StageTest {
 protected:
  void SetUp() override {
    choose_shape(device().traits, true);
    whole_ = device().traits;
    DeviceTraits& traits = device().traits;
    traits.project_block = 64;
    traits.blocks_apart = 8;
    traits.splats_of_part = 4;
    traits.fewest_parts = 4;
  }
  void TearDown() override { device().traits = whole_; }

  Image draw(const Frame& frame) {
    DrawnOnce drawn = draw_with_plan(device(), frame, make_plan(frame));
    counts_ = drawn.counts;
    return std::move(drawn.image);
  }
  Image draw_in_no_parts(const Frame& frame) {
    const DeviceTraits in_parts = device().traits;
    device().traits = whole_;
    Image image = draw(frame);
    device().traits = in_parts;
    return image;
  }
  bool has_parts(const Frame& frame) {
    return choose_key_parts(frame, make_plan(frame), device().traits).has_value();
  }
  const DrawCounts& counts() const { return counts_; }

  void expect_order_of_the_oracle_in_parts(const Frame& frame) {
    ASSERT_TRUE(has_parts(with_identities(frame)));
    expect_order_of_the_oracle(device(), frame);
  }

 private:
  DeviceTraits whole_;
  DrawCounts counts_;
};

DrawnComponent clouds_at(const std::vector<double>& depths, std::uint64_t seed) {
  Random random(seed);
  std::vector<Cloud> clouds;
  for (const double z : depths)
    clouds.push_back({random.uniform(-30, 30), random.uniform(-30, 30), z, 1, 1});
  DrawnComponent component = component_of(clouds, two_colors());
  component.absorption = {Absorption::Kind::gray, 0.2};
  return component;
}

std::vector<double> random_depths(int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> depths;
  for (int i = 0; i < count; ++i)
    depths.push_back(random.logarithmic(1, 1e3));
  return depths;
}

TEST_F(InParts, SplatsAreInTheOraclesOrder) {
  expect_order_of_the_oracle_in_parts(frame_of(50, 50, {clouds_at(random_depths(30011, 1), 1)}));
}

TEST_F(InParts, SplatsOfSeveralComponentsAreInTheOraclesOrder) {
  std::vector<DrawnComponent> components;
  for (const int count : {1, 700, 64, 5000})
    components.push_back(clouds_at(random_depths(count, 2), 2));
  expect_order_of_the_oracle_in_parts(frame_of(50, 50, components));
}

// In runs of equal keys that are longer than those that are sorted by comparing, and in short ones.
TEST_F(InParts, SplatsOfEqualDepthsAreInTheOrderOfTheirParticles) {
  for (const int depths : {40, 20011}) {
    Random random(3);
    std::vector<double> drawn;
    for (int i = 0; i < 30011; ++i)
      drawn.push_back(std::floor(random.uniform(0, depths)) * 40 / depths);
    expect_order_of_the_oracle_in_parts(frame_of(50, 50, {clouds_at(drawn, 3)}));
  }
}

// What the sample does not show lies beside all parts.
TEST_F(InParts, SplatsFarBeforeAndBehindTheOthersAreInOrder) {
  std::vector<double> depths = random_depths(30011, 4);
  for (std::size_t i = 0; i < 50; ++i) {
    depths[601 * i + 17] = 1e6 * (1.0 + static_cast<double>(i % 7));
    depths[601 * i + 203] = 1e-3 * (1.0 + static_cast<double>(i % 5));
  }
  expect_order_of_the_oracle_in_parts(frame_of(50, 50, {clouds_at(depths, 4)}));
}

TEST_F(InParts, SplatsAreInOrderByAFieldAndFarToNear) {
  for (const bool descending : {false, true}) {
    Frame frame = frame_of(50, 50, {clouds_at(random_depths(30011, 5), 5)});
    frame.sort.descending = descending;
    expect_order_of_the_oracle_in_parts(frame);
    Random random(6);
    std::vector<float> values;
    for (int i = 0; i < 30011; ++i)
      values.push_back(static_cast<float>(std::floor(random.uniform(-500, 500)) / 8));
    frame.components.front().particles.sort_field = Column::owning(values);
    frame.sort = {SortOrder::By::field, "key", descending};
    expect_order_of_the_oracle_in_parts(frame);
  }
}

TEST_F(InParts, PicturesHaveTheBitsOfThoseInNoParts) {
  int in_parts = 0;
  for (std::uint64_t seed = 1; seed < 1000 && in_parts < 8; ++seed) {
    const Frame frame = SceneMaker(seed).make();
    if (choose_light(frame) != LightPlan::ordered || !has_parts(frame)) continue;
    ++in_parts;
    const Image whole = draw_in_no_parts(frame);
    const DrawCounts of_whole = counts();
    EXPECT_EQ(draw(frame).pixels, whole.pixels) << "seed " << seed;
    EXPECT_EQ(counts().visible, of_whole.visible);
    EXPECT_EQ(counts().bad, of_whole.bad);
    EXPECT_EQ(counts().too_sharp, of_whole.too_sharp);
    EXPECT_EQ(counts().tile_entries, of_whole.tile_entries);
  }
  EXPECT_EQ(in_parts, 8);
}

// Among the splats, or as layers between them.
TEST_F(InParts, CloudsAroundTheCameraLieWhereTheyDoInNoParts) {
  for (const bool are_cut : {false, true}) {
    Frame frame = within_clouds();
    if (are_cut) frame.kernel.cut = 2;
    ASSERT_TRUE(has_parts(frame));
    const Image whole = draw_in_no_parts(frame);
    EXPECT_EQ(draw(frame).pixels, whole.pixels);
    EXPECT_GT(counts().around, 0u);
  }
}

}  // namespace
}  // namespace splotchcl::test
