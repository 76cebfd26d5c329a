#include <cstdint>
#include <numeric>
#include <vector>

#include "device/counted_column.h"
#include "scene/particle_columns.h"
#include "scene/scalar_map.h"
#include "scene/statistics.h"
#include "splotchcl/palette.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

using Color = std::array<double, 3>;

Particles three_particles() {
  Particles particles;
  particles.count = 3;
  particles.position = Column::owning({0, 1, 2, 3, 4, 5, 6, 7, 8});
  particles.weight = Column::owning({10, 11, 12});
  particles.color = Column::uniform(5);
  return particles;
}

TEST(SameColumns, AreThoseInTheSameMemory) {
  const Particles particles = three_particles();
  EXPECT_TRUE(have_same_columns(particles, Particles(particles)));
  EXPECT_FALSE(have_same_columns(particles, three_particles()));
}

TEST(SameColumns, HaveTheSameValueForAll) {
  const Particles particles = three_particles();
  Particles others = particles;
  others.color = Column::uniform(5);
  EXPECT_TRUE(have_same_columns(particles, others));
  others.color = Column::uniform(6);
  EXPECT_FALSE(have_same_columns(particles, others));
  others.color = Column();
  EXPECT_FALSE(have_same_columns(particles, others));
}

TEST(SameColumns, AreMadeByTheSameAndNotMadeForThat) {
  Particles particles = three_particles();
  const auto weights = std::make_shared<const CountedColumn>(particles.weight);
  particles.weight = Column::made_by(weights);
  Particles others = particles;
  others.weight = Column::made_by(weights);
  EXPECT_TRUE(have_same_columns(particles, others));
  others.weight = Column::made_by(std::make_shared<const CountedColumn>(three_particles().weight));
  EXPECT_FALSE(have_same_columns(particles, others));
  EXPECT_EQ(weights->made(), 0u);
}

TEST(PickedParticles, AreMadeAlone) {
  Particles particles = three_particles();
  const auto positions = std::make_shared<const CountedColumn>(particles.position);
  particles.position = Column::made_by(positions);
  const Particles picked = picked_particles(particles, {2, 0});
  ASSERT_EQ(picked.count, 2u);
  EXPECT_EQ(picked.position[1], 7);
  EXPECT_EQ(picked.position[3], 0);
  EXPECT_EQ(picked.weight[1], 10);
  EXPECT_EQ(picked.color.uniform_value(), 5);
  EXPECT_EQ(positions->made(), 6u);
}

// Close together, upwards and downwards, and far apart.
TEST(PickedParticles, AreReadTogetherWhereTheyLieCloseTogether) {
  constexpr std::uint64_t count = 100000;
  Particles particles;
  particles.count = count;
  std::vector<float> values(count);
  std::iota(values.begin(), values.end(), 0.0f);
  const auto weights = std::make_shared<const CountedColumn>(Column::owning(values));
  particles.weight = Column::made_by(weights);
  Places places;
  for (std::uint64_t i = 0; i < 40; ++i)
    places.push_back(500 + (7 * i) % 41);
  places.insert(places.end(), {count - 1, 0, count / 2});
  for (std::uint64_t i = 40; i-- > 0;)
    places.push_back(70000 + 5 * i);
  const Particles picked = picked_particles(particles, places);
  ASSERT_EQ(picked.count, places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    EXPECT_EQ(picked.weight[i], values[places[i]]) << i;
  EXPECT_LT(weights->made(), 700u);
}

TEST(ScalarMap, TellsTheLeastOfLogarithmsAndAsinhBeforeTheyAreTaken) {
  EXPECT_NEAR(least_before_scaling({Scaling::log, 3, 4}).value(), 1000, 1e-10);
  EXPECT_NEAR(least_before_scaling({Scaling::asinh, -1, 4}).value(), std::sinh(-1), 1e-15);
  EXPECT_FALSE(least_before_scaling({Scaling::linear, 3, 4}));
}

TEST(ScalarMap, TellsNoLeastThatFloatsCannotTakeFromOthers) {
  EXPECT_FALSE(least_before_scaling({Scaling::log, -38.5, -38}));
  EXPECT_FALSE(least_before_scaling({Scaling::log, -37, 0.5}));
  EXPECT_FALSE(least_before_scaling({Scaling::log, 39, 40}));
  EXPECT_FALSE(least_before_scaling({Scaling::asinh, 0, 43}));
}

const std::vector<Rgb> three_knots = {{0, 0.25f, 1}, {0.5f, 0.75f, 0}, {1, 0.25f, 0.5f}};

TEST(PaletteSampling, GivesTheKnotsAtEvenSteps) {
  EXPECT_EQ(sample_knots(three_knots, 0), (Color{0, 0.25, 1}));
  EXPECT_EQ(sample_knots(three_knots, 0.5), (Color{0.5, 0.75, 0}));
  EXPECT_EQ(sample_knots(three_knots, 1), (Color{1, 0.25, 0.5}));
}

TEST(PaletteSampling, IsLinearBetweenTheKnots) {
  // Quarters and these knots are exact in binary, so are the results.
  EXPECT_EQ(sample_knots(three_knots, 0.25), (Color{0.25, 0.5, 0.5}));
  EXPECT_EQ(sample_knots(three_knots, 0.625), (Color{0.625, 0.625, 0.125}));
}

TEST(PaletteSampling, IsConstantOutside) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double below : {-1e-300, -1.0, -infinity}) {
    EXPECT_EQ(sample_knots(three_knots, below), sample_knots(three_knots, 0)) << below;
  }
  for (const double above : {1.0000001, 2.0, infinity}) {
    EXPECT_EQ(sample_knots(three_knots, above), sample_knots(three_knots, 1)) << above;
  }
}

TEST(PaletteSampling, GivesTheFirstKnotForWhatIsNotANumber) {
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(sample_knots(three_knots, not_a_number), sample_knots(three_knots, 0));
}

TEST(PaletteSampling, OfASingleKnotIsThatColorEverywhere) {
  for (const double position : {-1.0, 0.0, 0.3, 1.0, 5.0}) {
    EXPECT_EQ(sample_knots({{0.25f, 0.5f, 0.75f}}, position), (Color{0.25, 0.5, 0.75})) << position;
  }
}

TEST(PaletteSampling, KeepsAStraightLineStraightForAnyNumberOfKnots) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(0, 1);
  for (std::size_t count = 2; count < 300; ++count) {
    std::vector<Rgb> line;
    for (std::size_t i = 0; i < count; ++i) {
      const float value = static_cast<float>(i) / static_cast<float>(count - 1);
      line.push_back({value, value, value});
    }
    const double position = anywhere(random);
    // The knots are rounded to single precision: 2^-25 at most for values up to 1.
    EXPECT_NEAR(sample_knots(line, position)[0], position, std::ldexp(1, -25) + 1e-15);
  }
}

TEST(PaletteSampling, StaysBetweenNeighboringKnotsAtTheLastBitBelowOne) {
  const Color color = sample_knots(three_knots, std::nextafter(1.0, 0.0));
  EXPECT_NEAR(color[0], 1, 1e-15);
  EXPECT_LE(color[0], 1);
}

std::vector<float> count_to(int last) {
  std::vector<float> values;
  // In an order of its own: 1009 is prime, so all numbers come.
  for (int i = 0; i <= last; ++i)
    values.push_back(static_cast<float>(i * 1009 % (last + 1)));
  return values;
}

TEST(Percentile, LiesBetweenTheNeighbors) {
  std::vector<double> values = {30, 10, 20};
  EXPECT_EQ(percentile(values, 0), 10);
  EXPECT_EQ(percentile(values, 0.25), 15);
  EXPECT_EQ(percentile(values, 0.5), 20);
  EXPECT_EQ(percentile(values, 1), 30);
}

TEST(BulkRange, LeavesOutHalfAPercentAtEachEnd) {
  const auto range = bulk_range(Column::owning(count_to(1000)), Scaling::linear);
  ASSERT_TRUE(range);
  EXPECT_NEAR(range->minimum, 5, 1e-9);
  EXPECT_NEAR(range->maximum, 995, 1e-9);
}

TEST(BulkRange, IsOfTheScaledValues) {
  const auto range = bulk_range(Column::owning({1, 10, 100, 1000, 10000}), Scaling::log);
  ASSERT_TRUE(range);
  EXPECT_NEAR(range->minimum, 0.02, 1e-9);
  EXPECT_NEAR(range->maximum, 3.98, 1e-9);
}

TEST(BulkRange, PassesOverValuesThatHaveNoPlace) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const auto range = bulk_range(Column::owning({0, -3, nan, infinity, 100, 100}), Scaling::log);
  ASSERT_TRUE(range);
  EXPECT_EQ(range->minimum, 2);
  EXPECT_EQ(range->maximum, 2);
}

TEST(BulkRange, IsNothingWhenNoValueHasAPlace) {
  EXPECT_FALSE(bulk_range(Column::owning({0, -3}), Scaling::log));
  EXPECT_FALSE(bulk_range(Column::owning({}), Scaling::linear));
}

TEST(BulkRange, OfOneValueForAllIsThatValue) {
  const auto range = bulk_range(Column::uniform(7), Scaling::linear);
  ASSERT_TRUE(range);
  EXPECT_EQ(range->minimum, 7);
  EXPECT_EQ(range->maximum, 7);
}

TEST(SampleStride, LooksAtNoMoreThanTheLimit) {
  EXPECT_EQ(sample_stride(0, 10), 1u);
  EXPECT_EQ(sample_stride(10, 10), 1u);
  EXPECT_EQ(sample_stride(11, 10), 2u);
  EXPECT_EQ(sample_stride(100, 10), 10u);
}

TEST(BulkRange, OfMoreThanTwoMillionValuesIsOfEvenlySpacedOnes) {
  std::vector<float> values(4000001, 1);
  for (std::size_t i = 0; i < values.size(); i += 3)
    values[i] = 5;  // every third is looked at
  const auto range = bulk_range(Column::owning(std::move(values)), Scaling::linear);
  ASSERT_TRUE(range);
  EXPECT_EQ(range->minimum, 5);
}

}  // namespace
}  // namespace splotchcl::test
