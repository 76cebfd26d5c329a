#include "formats/position_origin.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

namespace splotchcl {
namespace {

// The sampled particles, numbered through all parts.
std::vector<std::uint64_t> sampled(const std::vector<std::uint64_t>& part_sizes) {
  std::vector<std::uint64_t> particles;
  for (const SampleRange& range : sample_ranges(part_sizes)) {
    std::uint64_t start = 0;
    for (std::size_t part = 0; part < range.part; ++part)
      start += part_sizes[part];
    EXPECT_LE(range.first + range.count, part_sizes[range.part]);
    for (std::uint64_t i = 0; i < range.count; ++i)
      particles.push_back(start + range.first + i);
  }
  return particles;
}

TEST(PositionOrigin, SampleDoesNotDependOnHowParticlesAreSplit) {
  EXPECT_EQ(sampled({1000003}), sampled({5, 0, 400000, 17, 599981, 0}));
  EXPECT_EQ(sampled({100}), sampled({30, 30, 0, 40}));
}

TEST(PositionOrigin, SampleIsSpreadOverAllParticlesWithoutRepeating) {
  const auto particles = sampled({1000003});
  const std::set<std::uint64_t> different(particles.begin(), particles.end());
  EXPECT_EQ(different.size(), particles.size());
  EXPECT_GE(particles.size(), 4096U);
  EXPECT_LT(particles.size(), 5000U);
  for (std::uint64_t tenth = 0; tenth < 10; ++tenth) {
    EXPECT_LT(*different.lower_bound(tenth * 100000), (tenth + 1) * 100000);
  }
}

TEST(PositionOrigin, SmallSnapshotsAreSampledWhole) {
  EXPECT_EQ(sampled({60, 40}).size(), 100U);
  EXPECT_EQ(sampled({}).size(), 0U);
}

TEST(PositionOrigin, IsTheMedianOfEachAxisAsAFloat) {
  const Vec3 origin = choose_position_origin({{{1, 30, 0.1}}, {{2, 10, 0.1}}, {{100, 20, 0.1}}});
  EXPECT_EQ(origin.a[0], 2);
  EXPECT_EQ(origin.a[1], 20);
  EXPECT_EQ(origin.a[2], static_cast<double>(0.1F));
}

TEST(PositionOrigin, IgnoresPositionsThatAreNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Vec3 origin = choose_position_origin({{{nan, 1, 1e300}}, {{7, 1, 5}}, {{nan, 1, 1e300}}});
  EXPECT_EQ(origin.a[0], 7);
  EXPECT_EQ(origin.a[1], 1);
  EXPECT_EQ(origin.a[2], 5);
}

TEST(PositionOrigin, IsZeroWhenNoPositionIsFinite) {
  EXPECT_EQ(choose_position_origin({}).a[0], 0);
}

}  // namespace
}  // namespace splotchcl
