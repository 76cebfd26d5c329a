// Particles of two snapshots are found in each other by their ids, however many there are.
#include "between/id_match.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace splotchcl {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

using Ids = std::vector<std::uint64_t>;

// More than one block and many buckets.
constexpr std::size_t many = 300000;

Ids ids_in_any_order(std::size_t count, std::uint64_t first, std::uint64_t step, unsigned seed) {
  Ids ids;
  for (std::uint64_t i = 0; i < count; ++i)
    ids.push_back(first + step * i);
  std::shuffle(ids.begin(), ids.end(), std::mt19937_64(seed));
  return ids;
}

void expect_each_finds_its_own(const Ids& first, const Ids& second) {
  const IdMatch match = match_ids(first, second);
  ASSERT_EQ(match.place_in_second.size(), first.size());
  EXPECT_EQ(match.in_common, first.size());
  for (std::size_t i = 0; i < first.size(); ++i)
    ASSERT_EQ(second.at(match.place_in_second[i]), first[i]);
}

TEST(MatchedIds, AreThoseOfTheSameParticleInAnyOrder) {
  expect_each_finds_its_own(ids_in_any_order(many, 1, 1, 1), ids_in_any_order(many, 1, 1, 2));
}

TEST(MatchedIds, MayDifferInTheirUpperBitsAlone) {
  constexpr std::uint64_t step = std::uint64_t{1} << 45;
  expect_each_finds_its_own(ids_in_any_order(many, 3, step, 1), ids_in_any_order(many, 3, step, 2));
}

TEST(MatchedIds, LeaveOutWhatVanishesAndAppears) {
  const Ids first = ids_in_any_order(many, 0, 1, 1),
            second = ids_in_any_order(many, many / 3, 1, 2);
  const IdMatch match = match_ids(first, second);
  EXPECT_EQ(match.in_common, many - many / 3);
  EXPECT_EQ(match.appearing.size(), many / 3);
  EXPECT_TRUE(std::is_sorted(match.appearing.begin(), match.appearing.end()));
  for (const std::uint32_t place : match.appearing)
    ASSERT_GE(second[place], many);
  for (std::size_t i = 0; i < first.size(); ++i)
    ASSERT_EQ(match.place_in_second[i] == IdMatch::nobody, first[i] < many / 3);
  EXPECT_EQ(match.ambiguous, 0U);
}

TEST(MatchedIds, ThatAreSharedMatchNobody) {
  Ids first(many, 7);
  first.push_back(8);
  const IdMatch match = match_ids(first, {8, 7});
  EXPECT_EQ(match.in_common, 1U);
  EXPECT_EQ(match.place_in_second.back(), 0U);
  EXPECT_EQ(match.ambiguous, many);
  EXPECT_THAT(match.appearing, ElementsAre(1));
}

TEST(MatchedIds, OfNobodyAreNone) {
  const IdMatch vanishing = match_ids({1, 2}, {});
  EXPECT_THAT(vanishing.place_in_second, Each(IdMatch::nobody));
  EXPECT_THAT(vanishing.appearing, IsEmpty());
  EXPECT_THAT(match_ids({}, {5, 4}).appearing, ElementsAre(0, 1));
}

}  // namespace
}  // namespace splotchcl
