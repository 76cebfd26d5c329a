// The parts of ranks as one snapshot.
#include "splotchcl/spread_snapshot.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "splotchcl/error.h"
#include "spread/simulation.h"

namespace splotchcl::test {
namespace {

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

}  // namespace
}  // namespace splotchcl::test
