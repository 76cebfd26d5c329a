#include <boost/qvm/vec_operations.hpp>

#include "cells/healpix_grid.h"
#include "cells/picture_of_the_sky.h"
#include "cells/shares_on_the_sky.h"
#include "scene/constants.h"
#include "testing.h"

namespace splotchcl {
namespace {

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
