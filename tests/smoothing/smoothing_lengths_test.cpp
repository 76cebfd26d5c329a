#include "smoothing/smoothing_lengths.h"

#include "testing.h"

namespace splotchcl {
namespace {

std::vector<float> random_positions(std::size_t count, float size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0, size);
  std::vector<float> positions(3 * count);
  for (float& x : positions)
    x = uniform(random);
  return positions;
}

// The k-th smallest distance to the others, and to all images when there is a box.
double brute_force(const std::vector<float>& positions, std::size_t particle, std::size_t k,
                   double box) {
  const int images = box > 0 ? 1 : 0;
  std::vector<double> distances;
  for (std::size_t other = 0; other < positions.size() / 3; ++other) {
    for (int x = -images; x <= images; ++x) {
      for (int y = -images; y <= images; ++y) {
        for (int z = -images; z <= images; ++z) {
          if (other == particle && x == 0 && y == 0 && z == 0) continue;
          const double shift[3] = {x * box, y * box, z * box};
          double squared = 0;
          for (std::size_t axis = 0; axis < 3; ++axis) {
            const double difference = static_cast<double>(positions[3 * other + axis]) +
                                      shift[axis] -
                                      static_cast<double>(positions[3 * particle + axis]);
            squared += difference * difference;
          }
          distances.push_back(std::sqrt(squared));
        }
      }
    }
  }
  const auto kth = distances.begin() + static_cast<std::ptrdiff_t>(k - 1);
  std::nth_element(distances.begin(), kth, distances.end());
  return *kth;
}

void expect_brute_force(const std::vector<float>& positions, std::size_t k, double box) {
  const std::size_t count = positions.size() / 3;
  const Column lengths = find_smoothing_lengths(Column::owning(positions), count,
                                                box > 0 ? std::optional<double>(box) : std::nullopt,
                                                static_cast<int>(k));
  ASSERT_EQ(lengths.size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    const double expected = brute_force(positions, i, k, box);
    // Differences of coordinates, and positions of images, are rounded to single precision:
    // to 2^-24 of coordinates that reach twice the size of 100.
    ASSERT_NEAR(static_cast<double>(lengths[i]), expected, 4 * 200 * 0x1p-24) << i;
  }
}

TEST(SmoothingLengths, AreTheDistancesThatBruteForceFinds) {
  expect_brute_force(random_positions(300, 100, 1), 32, 0);
  expect_brute_force(random_positions(65, 100, 2), 64, 0);
}

TEST(SmoothingLengths, AreFoundAcrossTheFacesOfAPeriodicBox) {
  expect_brute_force(random_positions(250, 100, 3), 32, 100);
}

TEST(SmoothingLengths, PeriodicBoxMayBeginAnywhere) {
  std::vector<float> positions = random_positions(150, 100, 4);
  for (float& x : positions)
    x -= 70;
  expect_brute_force(positions, 20, 100);
}

TEST(SmoothingLengths, OfClusteredParticlesAreFoundToo) {
  std::vector<float> positions = random_positions(100, 100, 5);
  const std::vector<float> clump = random_positions(150, 0.01F, 6);
  for (const float x : clump)
    positions.push_back(99.99F + x);  // at a corner of the box
  expect_brute_force(positions, 48, 100);
}

TEST(SmoothingLengths, AreTheSameInEveryRun) {
  const Column positions = Column::owning(random_positions(12000, 1, 7));
  const Column first = find_smoothing_lengths(positions, 12000, 1.0);
  const Column second = find_smoothing_lengths(positions, 12000, 1.0);
  EXPECT_TRUE(std::equal(first.data(), first.data() + 12000, second.data()));
}

TEST(SmoothingLengths, WithFewerParticlesThanNeighborsReachTheFarthest) {
  const Column lengths = find_smoothing_lengths(Column::owning({0, 0, 0, 3, 0, 0, 3, 4, 0}), 3);
  EXPECT_EQ(lengths[0], 5);
  EXPECT_EQ(lengths[1], 4);
  EXPECT_EQ(lengths[2], 5);
}

TEST(SmoothingLengths, OfALoneParticleIsOne) {
  EXPECT_EQ(find_smoothing_lengths(Column::owning({5, 6, 7}), 1)[0], 1);
}

TEST(SmoothingLengths, OfALoneParticleInABoxIsAThousandthOfTheBox) {
  EXPECT_EQ(find_smoothing_lengths(Column::owning({5, 6, 7}), 1, 50.0)[0], 0.05F);
}

TEST(SmoothingLengths, OfNoParticlesAreNone) {
  EXPECT_EQ(find_smoothing_lengths(Column::owning({}), 0).size(), 0U);
}

TEST(SmoothingLengths, OfCoincidentParticlesAreTheSmallestOfOthers) {
  std::vector<float> positions(3 * 100, 1);  // 100 particles at one place
  positions.insert(positions.end(), {1, 1, 3, 1, 1, 11});
  const Column lengths = find_smoothing_lengths(Column::owning(positions), 102, {}, 10);
  EXPECT_EQ(lengths[100], 2);
  EXPECT_EQ(lengths[101], 10);
  for (std::size_t i = 0; i < 100; ++i)
    ASSERT_EQ(lengths[i], 2);
}

// As where a file was cut, or a code keeps what has left its box at one place. Where each looked at
// all the others it would take hours.
TEST(SmoothingLengths, OfVeryManyCoincidentParticlesTakeNoLongerThanOfOthers) {
  const std::size_t coincident = static_cast<std::size_t>(test::rounds(2000000)), others = 1000;
  std::vector<float> positions = random_positions(others, 1, 9);
  positions.resize(3 * (others + coincident), 0.5F);
  const Column lengths = find_smoothing_lengths(Column::owning(positions), others + coincident);
  float smallest = lengths[0];
  for (std::size_t i = 0; i < others; ++i)
    smallest = std::min(smallest, lengths[i]);
  for (std::size_t i = others; i < others + coincident; ++i)
    ASSERT_EQ(lengths[i], smallest);
}

TEST(SmoothingLengths, WhereAllCoincideAreAThousandthOfTheExtent) {
  std::vector<float> positions(3 * 50, 0);
  positions.resize(3 * 100, 8);
  const Column lengths = find_smoothing_lengths(Column::owning(positions), 100, {}, 10);
  for (std::size_t i = 0; i < 100; ++i)
    ASSERT_EQ(lengths[i], 0.008F);
}

TEST(SmoothingLengths, OfBadPositionsAreBadAndDisturbNobody) {
  std::vector<float> positions = random_positions(500, 100, 8);
  const Column good = find_smoothing_lengths(Column::owning(positions), 500);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  positions.insert(positions.begin() + 3 * 200, {nan, 50, 50});
  positions.insert(positions.end(), {50, std::numeric_limits<float>::infinity(), 50});
  const Column lengths = find_smoothing_lengths(Column::owning(positions), 502);
  EXPECT_TRUE(std::isnan(lengths[200]));
  EXPECT_TRUE(std::isnan(lengths[501]));
  for (std::size_t i = 0; i < 500; ++i)
    ASSERT_EQ(lengths[i < 200 ? i : i + 1], good[i]);
}

TEST(SmoothingLengths, InCentimetresDoNotOverflow) {
  std::vector<float> positions = random_positions(200, 1, 9);
  for (float& x : positions)
    x *= 3e24F;  // a megaparsec; its square is beyond single precision
  const Column lengths = find_smoothing_lengths(Column::owning(positions), 200);
  for (std::size_t i = 0; i < 200; ++i)
    ASSERT_TRUE(lengths[i] > 1e23F && lengths[i] < 6e24F);
}

TEST(SmoothingLengths, ReportTheirProgressUpToOne) {
  std::vector<double> reported;
  find_smoothing_lengths(Column::owning(random_positions(10000, 1, 10)), 10000, {}, 8,
                         [&](double fraction) { reported.push_back(fraction); });
  ASSERT_FALSE(reported.empty());
  EXPECT_TRUE(std::is_sorted(reported.begin(), reported.end()));
  EXPECT_EQ(reported.back(), 1);
}

TEST(SmoothingLengths, NeedPositionsOfAllParticles) {
  EXPECT_THROW(find_smoothing_lengths(Column::owning({1, 2, 3}), 2), DataError);
  EXPECT_THROW(find_smoothing_lengths(Column(), 1), DataError);
}

TEST(SmoothingLengths, FromDensityHoldSixtyFourParticles) {
  const Column lengths =
      smoothing_lengths_from_density(Column::uniform(2), Column::owning({0.5F, 4}), 2);
  for (std::size_t i = 0; i < 2; ++i) {
    const double h = static_cast<double>(lengths[i]);
    const double density = i == 0 ? 0.5 : 4;
    // Three roundings to single precision of h, in the cube.
    EXPECT_NEAR(4 * M_PI / 3 * h * h * h * density / 2, 64, 64 * 3 * 0x1p-24);
  }
}

TEST(SmoothingLengths, FromADensityOfZeroAreNotFinite) {
  const Column lengths = smoothing_lengths_from_density(Column::uniform(1), Column::owning({0}), 1);
  EXPECT_FALSE(std::isfinite(lengths[0]));
}

}  // namespace
}  // namespace splotchcl
