#include "cells/sky_lattice.h"

#include <boost/qvm/vec_operations.hpp>

#include "scene/constants.h"
#include "testing.h"

namespace splotchcl {
namespace {

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

}  // namespace
}  // namespace splotchcl
