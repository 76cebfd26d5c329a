// Kernels shared out to cells of grids and of the sky.
#include <boost/qvm/vec_operations.hpp>

#include "cells/gaussian.h"
#include "cells/shares_on_the_sky.h"
#include "cells/sky_grid.h"
#include "cells/sky_lattice.h"
#include "scene/constants.h"
#include "testing.h"

namespace splotchcl {
namespace {

double sum_of(const std::vector<CellShare>& shares) {
  double sum = 0;
  for (const CellShare& share : shares)
    sum += share.part;
  return sum;
}

TEST(GaussianBetween, KeepsItsDigitsFarOut) {
  const double part = gaussian_between(5, 5.5, 1);
  EXPECT_NEAR(part / (0.5 * (std::erfc(5.0) - std::erfc(5.5))), 1, 1e-14);
  EXPECT_EQ(gaussian_between(-5.5, -5, 1), part);
  EXPECT_DOUBLE_EQ(gaussian_between(-100, 100, 1), 1);
}

TEST(GaussianInShell, HasTheDensityTimesTheVolumeOfAThinShell) {
  constexpr double sigma = 2, radius = 1e-4, width = 1e-6;
  const double density = 1 / (std::pow(pi, 1.5) * std::pow(sigma, 3));
  for (const double distance : {0.0, 1.0, 5.0}) {
    const double expected =
        density * std::exp(-std::pow(distance / sigma, 2)) * 4 * pi * radius * radius * width;
    EXPECT_NEAR(
        gaussian_in_shell(distance, radius - width / 2, radius + width / 2, sigma) / expected, 1,
        1e-4);
  }
}

TEST(GaussianInShell, AddsUpToTheWhole) {
  for (const double distance : {0.0, 0.3, 7.0, 1e3}) {
    std::vector<double> edges = {0};
    while (edges.back() < 2e3)
      edges.push_back(edges.back() + 0.01 + 0.1 * edges.back());
    std::vector<CellShare> shares;
    add_shares_in_shells(edges, distance, 1, shares);
    EXPECT_NEAR(sum_of(shares), 1, 1e-9) << distance;
  }
}

TEST(SharesAlongAnAxis, ArePeriodic) {
  const CellsAlongAxis cells = {0, 0.25, 4, 1.0};
  std::vector<SharesAlongAxis> rows;
  find_shares_along_axis(cells, 0.0, 2.0, rows);
  std::vector<double> sums(4);
  for (const SharesAlongAxis& row : rows) {
    for (std::size_t i = 0; i < row.parts.size(); ++i)
      sums[static_cast<std::size_t>(row.first) + i] += row.parts[i];
  }
  for (const double sum : sums)
    EXPECT_NEAR(sum, 0.25, 1e-12);
}

TEST(GaussianOnSky, OfOneAroundTheOriginIsEven) {
  const GaussianOnSky particle({{0, 0, 0}}, 3);
  EXPECT_NEAR(particle({{0, 1, 0}}), 1 / (4 * pi), 1e-15);
  EXPECT_EQ(particle.reach(), pi);
}

TEST(GaussianOnSky, FarAwayIsFlat) {
  const GaussianOnSky particle({{0, 0, 1e6}}, 10);
  const double angle = 2e-5, width = 1e-5;
  const double expected = std::exp(-std::pow(angle / width, 2)) / (pi * width * width);
  EXPECT_NEAR(particle({{std::sin(angle), 0, std::cos(angle)}}) / expected, 1, 1e-8);
}

Vec3 anywhere_on_the_sky(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const Vec3 place = {{normal(random), normal(random), normal(random)}};
  return place / mag(place);
}

std::vector<double> values_at_points(const SkyLattice& lattice, const GaussianOnSky& particle) {
  std::vector<CellShare> shares;
  lattice.add_values(particle, particle.reach(), shares);
  std::vector<double> values(lattice.points());
  for (const CellShare& share : shares)
    values[share.cell] += share.part;
  return values;
}

// Over the value in its middle: between points in all directions, and around the middle.
double worst_error(const SkyLattice& lattice, const std::vector<double>& values,
                   const GaussianOnSky& particle, std::mt19937& random) {
  double worst = 0;
  for (int i = 0; i < 400; ++i) {
    Vec3 direction = anywhere_on_the_sky(random);
    if (i % 2 == 0) direction = particle.middle() + 2 * particle.width() * direction;
    direction = direction / mag(direction);
    const double found = lattice.stencil_at(direction).of(values);
    worst = std::max(worst, std::abs(found - particle(direction)));
  }
  return worst / particle(particle.middle());
}

TEST(SkyLattice, HasWhatLiesBetweenItsPoints) {
  std::mt19937 random(1);
  for (int i = 0; i < 40; ++i) {
    const double distance = std::exp(std::uniform_real_distribution<double>(-3, 3.5)(random));
    const GaussianOnSky particle(distance * anywhere_on_the_sky(random), 1);
    const SkyLattice lattice(SkyLattice::level_for(particle.width()));
    EXPECT_LT(worst_error(lattice, values_at_points(lattice, particle), particle, random),
              lattice_error)
        << particle.width();
  }
}

TEST(SkyLattice, HasTheSameInItsNextLevel) {
  std::mt19937 random(2);
  for (int i = 0; i < 10; ++i) {
    const GaussianOnSky particle(3.0 * anywhere_on_the_sky(random), 1);
    const int level = SkyLattice::level_for(particle.width());
    const std::vector<double> finer =
        SkyLattice(level).refined(values_at_points(SkyLattice(level), particle));
    EXPECT_LT(worst_error(SkyLattice(level + 1), finer, particle, random), lattice_error);
  }
}

TEST(SkyLattice, HasNothingBeyondTheReach) {
  const GaussianOnSky particle({{0, 20, 0}}, 1);
  const SkyLattice lattice(SkyLattice::level_for(particle.width()));
  const std::vector<double> values = values_at_points(lattice, particle);
  const auto seen = std::count_if(values.begin(), values.end(), [](double v) { return v > 0; });
  EXPECT_GT(seen, 1000);
  EXPECT_LT(static_cast<std::size_t>(seen), lattice.points() / 10);
}

constexpr HealpixOrder ring = HealpixOrder::ring, nested = HealpixOrder::nested;

struct KnownPixel {
  int nside;
  HealpixOrder order;
  std::size_t number;
  Vec3 direction;
};

// By healpy 1.20.1's pix2vec.
const KnownPixel known_pixels[] = {
    {1, ring, 8, {{0.527046276695, 0.527046276695, -0.666666666667}}},
    {1, ring, 5, {{0.000000000000, 1.000000000000, 0.000000000000}}},
    {1, ring, 11, {{0.527046276695, -0.527046276695, -0.666666666667}}},
    {4, ring, 137, {{0.800103145191, 0.331413574036, -0.500000000000}}},
    {4, ring, 179, {{0.563097269935, -0.150881458739, -0.812500000000}}},
    {4, ring, 98, {{-0.555570233020, -0.831469612303, 0.000000000000}}},
    {4, nested, 137, {{0.619740858111, 0.414097602436, -0.666666666667}}},
    {4, nested, 179, {{0.412215811196, -0.412215811196, -0.812500000000}}},
    {4, nested, 98, {{-0.924693230215, 0.183932919522, -0.333333333333}}},
    {128, ring, 144881, {{-0.865670855067, 0.161175274010, -0.473958333333}}},
    {128, ring, 92821, {{0.254447038562, -0.965388196270, 0.057291666667}}},
    {128, nested, 139553, {{0.500822921945, 0.165766664078, -0.849527994792}}},
    {128, nested, 129598, {{-0.280285315625, -0.903971774025, 0.322916666667}}},
};

TEST(HealpixGrid, NumbersPixelsAsHealpyDoes) {
  for (const KnownPixel& known : known_pixels) {
    const HealpixGrid grid(known.nside, known.order);
    EXPECT_EQ(grid.cell_at(known.direction), known.number);
  }
}

// Each once, and each where it is.
TEST(HealpixGrid, HasEachPixelOnce) {
  for (const HealpixOrder order : {ring, nested}) {
    constexpr int nside = 16;
    const HealpixGrid grid(nside, order);
    std::vector<int> times(grid.cells());
    for (int face = 0; face < 12; ++face) {
      for (int x = 0; x < nside; ++x) {
        for (int y = 0; y < nside; ++y) {
          const std::size_t cell = grid.cell(face, x, y);
          ++times[cell];
          EXPECT_EQ(grid.cell_at(grid.direction(face, x + 0.5, y + 0.5)), cell);
        }
      }
    }
    EXPECT_EQ(std::count(times.begin(), times.end(), 1), static_cast<long>(grid.cells()));
  }
}

Vec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> part(0, 1);
  return boost::qvm::normalized(Vec3{{part(random), part(random), part(random)}});
}

TEST(HealpixGrid, HasPatchesWithinTheirRadius) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(0, 1);
  for (const double side : {8.0, 2.0, 1.0, 0.25, 0x1p-30}) {
    const HealpixGrid grid(8, ring);
    for (int i = 0; i < 5000; ++i) {
      const double x = side * std::floor(8 / side * part(random)),
                   y = side * std::floor(8 / side * part(random));
      const SkyPatch patch = {i % 12, x, y, side, side};
      const Vec3 middle = grid.direction(patch.face, x + side / 2, y + side / 2);
      const Vec3 corner =
          grid.direction(patch.face, x + side * (i / 12 % 2), y + side * (i / 24 % 2));
      const double chord = boost::qvm::mag(Vec3(middle - corner));
      EXPECT_LE(chord, 2 * std::sin(grid.radius(patch) / 2) * (1 + 1e-6));
    }
  }
}

std::map<std::size_t, double> sums_of(const std::vector<CellShare>& shares) {
  std::map<std::size_t, double> sums;
  for (const CellShare& share : shares)
    sums[share.cell] += share.part;
  return sums;
}

// At the pole, on the bend of directions, and elsewhere; as wide as the sky, or far below a pixel.
TEST(SharesOnTheSky, AreWithinTheToleranceOfExactOnes) {
  std::mt19937 random(3);
  const HealpixGrid grid(8, ring);
  for (const double width : {3.0, 0.3, 0.05, 0.004}) {
    for (int i = 0; i < 12; ++i) {
      Vec3 place = random_direction(random);
      if (i == 0) place = {{0, 0, 1}};
      if (i == 1) place = {{std::sqrt(5.0) / 3, 0.01, 2.0 / 3}};
      const GaussianOnSky particle(place, width * boost::qvm::mag(place));
      constexpr double floor = 1e-3, tolerance = 1e-3;
      std::vector<CellShare> shares, exact;
      add_shares_on_the_sky(grid, particle, {tolerance / 4, floor}, shares);
      add_shares_on_the_sky(grid, particle, {1e-8, floor}, exact);
      const double least = floor * particle(particle.middle()) * grid.solid_angle(0);
      auto found = sums_of(shares);
      double sum = 0;
      for (const auto& [cell, part] : sums_of(exact)) {
        EXPECT_NEAR(found[cell], part, tolerance * std::max(part, least)) << width << ' ' << i;
        sum += found[cell];
      }
      EXPECT_NEAR(sum, 1, 1e-9);
    }
  }
}

// The pixel of its direction, wherever that is.
TEST(SharesOnTheSky, LoseNoSmallParticle) {
  std::mt19937 random(5);
  const HealpixGrid grid(64, nested);
  for (int i = 0; i < test::rounds(15000); ++i) {
    std::vector<CellShare> shares;
    const GaussianOnSky particle(random_direction(random), 1e-8);
    add_shares_on_the_sky(grid, particle, {1e-3, 1e-3}, shares);
    double sum = 0;
    for (const CellShare& share : shares)
      sum += share.part;
    ASSERT_NEAR(sum, 1, 1e-9) << i;
  }
}

TEST(PictureOfTheSky, HasAllOfAParticleWithinIt) {
  const PictureOfTheSky grid(PictureOfTheSky::Projection::tan, 21, 13, 30, 40, 2);
  const Vec3 middle = grid.direction(0, 10.2, 6.4);
  std::vector<CellShare> shares;
  add_shares_on_the_sky(grid, GaussianOnSky(middle, 0.02), {1e-6, 1e-6}, shares);
  double sum = 0;
  for (const CellShare& share : shares)
    sum += share.part;
  EXPECT_NEAR(sum, 1, 1e-5);
}

TEST(PictureOfTheSky, HasTheSolidAngleOfTheSky) {
  const PictureOfTheSky grid(PictureOfTheSky::Projection::car, 36, 18, 0, 0, 10);
  EXPECT_TRUE(grid.has_all_of_the_sky());
  double sum = 0;
  for (std::size_t cell = 0; cell < grid.cells(); ++cell)
    sum += grid.solid_angle(cell);
  EXPECT_NEAR(sum, 4 * pi, 1e-12);
}

TEST(PictureOfTheSky, FindsTheCellsOfItsDirections) {
  using Projection = PictureOfTheSky::Projection;
  for (const Projection projection : {Projection::tan, Projection::car}) {
    const PictureOfTheSky grid(projection, 20, 10, 100, 10, 3);
    for (const auto& [x, y] : {std::pair{0, 0}, {19, 9}, {7, 3}})
      EXPECT_EQ(grid.cell_at(grid.direction(0, x + 0.5, y + 0.5)), grid.cell(0, x, y));
  }
}

}  // namespace
}  // namespace splotchcl
