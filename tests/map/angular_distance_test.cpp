#include <gtest/gtest.h>

#include <cmath>

#include "map/sky.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr double hubble_distance = 299792.458 / 70;  // in Mpc

SnapshotInfo at(double redshift, double omega_matter, double omega_lambda) {
  SnapshotInfo snapshot;
  snapshot.hubble_parameter = 0.7;
  snapshot.cosmology.emplace();
  snapshot.cosmology->scale_factor = 1 / (1 + redshift);
  snapshot.cosmology->omega_matter = omega_matter;
  snapshot.cosmology->omega_lambda = omega_lambda;
  return snapshot;
}

// Without a cosmological constant Mattig's formula is exact.
double mattig(double z, double omega) {
  const double bracket = omega * z + (omega - 2) * (std::sqrt(1 + omega * z) - 1);
  return 2 * hubble_distance * bracket / std::pow(omega * (1 + z), 2);
}

TEST(AngularDistance, IsMattigsWithoutACosmologicalConstant) {
  for (const double omega : {0.3, 1.0, 1.7}) {
    for (const double z : {0.01, 1.0, 3.0, 100.0})
      EXPECT_NEAR(angular_distance_in_mpc(at(z, omega, 0)) / mattig(z, omega), 1, 1e-9);
  }
}

// 4282.7494 Mpc * 0.7714271 / 2, with the integral of dz / sqrt(0.3 (1 + z)^3 + 0.7) in 200000
// steps.
TEST(AngularDistance, OfAFlatUniverseIsTheIntegralOverTwo) {
  EXPECT_NEAR(angular_distance_in_mpc(at(1, 0.3, 0.7)), 1651.914, 0.01);
}

TEST(AngularDistance, IsRefusedWhereItDoesNotFollow) {
  EXPECT_THROW(angular_distance_in_mpc(at(0, 0.3, 0.7)), UsageError);
  EXPECT_THROW(angular_distance_in_mpc(SnapshotInfo()), UsageError);
  SnapshotInfo snapshot = at(1, 0.3, 0.7);
  snapshot.hubble_parameter.reset();
  EXPECT_THROW(angular_distance_in_mpc(snapshot), UsageError);
}

}  // namespace
}  // namespace splotchcl
