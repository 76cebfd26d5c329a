#include "cells/gaussian.h"

#include "cells/shares_along_an_axis.h"
#include "cells/shares_in_shells.h"
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

}  // namespace
}  // namespace splotchcl
