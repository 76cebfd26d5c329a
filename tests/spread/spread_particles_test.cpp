// Columns of which each rank has a part.
#include "ranks/spread_particles.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "splotchcl/error.h"
#include "spread/simulation.h"

namespace splotchcl::test {
namespace {

// 0, 1, 2, ... of which rank r has 1000 r: none of them the first one's.
Column numbers(SpreadParticles& spread) {
  const auto rank = static_cast<std::size_t>(spread.ranks().rank());
  std::vector<float> own(1000 * rank);
  std::iota(own.begin(), own.end(), static_cast<float>(500 * rank * (rank - 1)));
  const std::size_t count = own.size();
  return spread.spread(Column::owning(std::move(own)), count, 1);
}

void with_ranks(int size, const std::function<void(SpreadParticles&)>& work) {
  ThreadRanks::run(size, [&](Communicator& ranks) {
    work(*std::make_shared<SpreadParticles>(borrowed(ranks)));
  });
}

std::vector<float> made(const Column& column, std::size_t begin, std::size_t end) {
  std::vector<float> values(end - begin);
  column.source()->make(begin, end, values.data());
  return values;
}

std::vector<float> counted(std::size_t begin, std::size_t end) {
  std::vector<float> values(end - begin);
  std::iota(values.begin(), values.end(), static_cast<float>(begin));
  return values;
}

TEST(SpreadParticles, HaveAllValuesOnAllRanks) {
  with_ranks(4, [](SpreadParticles& spread) {
    const Column column = numbers(spread);
    ASSERT_EQ(column.size(), 6000u);
    EXPECT_EQ(made(column, 0, 6000), counted(0, 6000));
    EXPECT_EQ(made(column, 900, 3100), counted(900, 3100));
    for (const std::size_t i :
         {std::size_t{5999}, std::size_t{0}, std::size_t{1}, std::size_t{3000}})
      EXPECT_EQ(column[i], static_cast<float>(i));
  });
}

TEST(SpreadParticles, LeaveOneValueForAllAsItIs) {
  with_ranks(2, [](SpreadParticles& spread) {
    EXPECT_EQ(spread.spread(Column::uniform(3), 7, 1).uniform_value(), 3);
    EXPECT_TRUE(spread.spread(Column(), 7, 1).is_absent());
  });
}

TEST(SpreadParticles, GiveEachRankWhatItHasAskedFor) {
  with_ranks(3, [](SpreadParticles& spread) {
    const Column column = numbers(spread);
    const auto first = 700 * static_cast<std::size_t>(spread.ranks().rank());
    spread.fetch([&] {
      made(column, first, first + 500);
      made(column, first + 400, first + 900);
      made(column, 2500, 2600);
    });
    EXPECT_EQ(made(column, first, first + 900), counted(first, first + 900));
    EXPECT_EQ(made(column, 2510, 2511), counted(2510, 2511));
    spread.forget();
    EXPECT_EQ(made(column, 0, 3000), counted(0, 3000));
  });
}

TEST(SpreadParticles, RefuseWhatHasNotBeenFetched) {
  with_ranks(2, [](SpreadParticles& spread) {
    const Column column = numbers(spread);
    spread.fetch([&] { made(column, 0, 10); });
    if (spread.ranks().rank() == 0) {
      EXPECT_THROW(made(column, 10, 20), DataError);
    }
  });
}

}  // namespace
}  // namespace splotchcl::test
