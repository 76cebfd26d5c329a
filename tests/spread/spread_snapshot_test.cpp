#include "splotchcl/spread_snapshot.h"

#include "ranks/spread_particles.h"
#include "spread/simulation.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// The parts of ranks as one snapshot.

TEST(SpreadSnapshot, HasTheParticlesOfAllRanks) {
  const Arrays arrays = gas_and_stars(100, 10);
  ThreadRanks::run(3, [&](Communicator& ranks) {
    const Arrays part = part_of_rank(arrays, uneven(3), ranks.rank());
    ArraySnapshot own;
    own.set_box_size(3);
    set_fields(part, own);
    const SpreadSnapshot all(own, borrowed(ranks));
    ASSERT_EQ(all.info().types.size(), 2u);
    EXPECT_EQ(all.info().find_type(gas)->count, 100u);
    EXPECT_EQ(all.info().find_type(stars)->count, 10u);
    EXPECT_EQ(all.info().box_size, 3);
    EXPECT_EQ(all.own_part().info().find_type(gas)->count, part.at(gas).count);
    const Column mass = all.read(stars, "mass");
    ASSERT_EQ(mass.size(), 10u);
    for (std::size_t i = 0; i < 10; ++i)
      EXPECT_EQ(mass[i], arrays.at(stars).scalars.at("mass")[i]);
  });
}

TEST(SpreadSnapshot, OfOneRankIsItsOwn) {
  const Arrays arrays = gas_and_stars(10, 10);
  ThreadRanks::run(1, [&](Communicator& ranks) {
    ArraySnapshot own;
    set_fields(arrays, own);
    const SpreadSnapshot all(own, borrowed(ranks));
    EXPECT_EQ(all.spread(), nullptr);
    EXPECT_EQ(all.read(gas, "mass").data(), own.read(gas, "mass").data());
  });
}

// What the first rank that has failed says; all others have failed with it.
std::string failure_of(int size, const std::function<void(int rank, ArraySnapshot&)>& set) {
  std::string message;
  ThreadRanks::run(size, [&](Communicator& ranks) {
    ArraySnapshot own;
    set(ranks.rank(), own);
    try {
      const SpreadSnapshot all(own, borrowed(ranks));
      ADD_FAILURE() << "the parts were taken";
    } catch (const UsageError& error) {
      message = error.what();
    } catch (const FailedElsewhere& elsewhere) {
      EXPECT_TRUE(elsewhere.is_usage());
    }
  });
  return message;
}

const std::vector<float> values(30, 1.0F);

TEST(SpreadSnapshot, RefusesOtherFields) {
  const std::string message = failure_of(3, [](int rank, ArraySnapshot& own) {
    if (rank == 0) return;  // it has none
    own.set_field(gas, "position", values.data(), 10, 3);
    if (rank == 2) own.set_field(gas, "density", values.data(), 10);
  });
  EXPECT_EQ(message,
            "particles of type 0 spread over processes: found fields density, position (3 values) "
            "on rank 2, expected those of rank 1, position (3 values); give all ranks with "
            "particles of the type the same");
}

TEST(SpreadSnapshot, RefusesOtherMasses) {
  const std::string message = failure_of(2, [](int rank, ArraySnapshot& own) {
    own.set_field(gas, "position", values.data(), 10, 3);
    own.set_mass(gas, 1 + rank);
  });
  EXPECT_NE(message.find("the mass for all 2 on rank 1"), std::string::npos) << message;
}

TEST(SpreadSnapshot, RefusesOtherBoxes) {
  const std::string message =
      failure_of(2, [](int rank, ArraySnapshot& own) { own.set_box_size(1 + rank); });
  EXPECT_NE(message.find("box size"), std::string::npos) << message;
}

// Columns of which each rank has a part.

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
