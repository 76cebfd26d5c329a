// What snapshots tell of the expansion and of their velocities.
#include <gtest/gtest.h>

#include <cmath>

#include "formats/hdf5/snapshot_hdf5_writer.h"
#include "formats/snapshot_writer.h"
#include "paths.h"
#include "splotchcl/snapshot.h"
#include "splotchcl/snapshot_file.h"
#include "temporary_folder.h"

namespace splotchcl {
namespace {

using namespace splotchcl::test;

TEST(SnapshotMotion, IsCosmologicalWhereTheTimeIsTheScaleFactor) {
  const TemporaryFolder folder;
  const TestSnapshot snapshot = small_snapshot();  // time 0.5, redshift 1, Omega0 0.3
  write_gadget(folder / "snap", snapshot, 2);
  write_hdf5(folder / "snap.hdf5", snapshot);
  for (const char* const name : {"snap", "snap.hdf5"}) {
    SCOPED_TRACE(name);
    const auto opened = open_snapshot(folder / name);
    ASSERT_TRUE(opened->info().cosmology);
    EXPECT_EQ(opened->info().cosmology->scale_factor, 0.5);
    EXPECT_EQ(opened->info().cosmology->omega_matter, 0.3);
    EXPECT_EQ(opened->info().cosmology->velocity_power, 0.5);
    // 100 h km/s/Mpc in km/s per kpc/h.
    EXPECT_NEAR(opened->info().cosmology->hubble_rate, 0.1, 1e-12);
  }
}

TEST(SnapshotMotion, IsNewtonianWhereTimeAndRedshiftDisagree) {
  const TemporaryFolder folder;
  TestSnapshot snapshot = small_snapshot();
  snapshot.redshift = 0;  // with a time of 0.5
  write_gadget(folder / "snap", snapshot, 2);
  EXPECT_FALSE(open_snapshot(folder / "snap")->info().cosmology);
}

TEST(SnapshotMotion, IsNewtonianWithoutMatterDensity) {
  const TemporaryFolder folder;
  TestSnapshot snapshot = small_snapshot();
  snapshot.omega_matter = 0;
  write_gadget(folder / "snap", snapshot, 2);
  EXPECT_FALSE(open_snapshot(folder / "snap")->info().cosmology);
}

TEST(RealSnapshotMotion, FollowsTheUnitsOfEachCode) {
  const std::filesystem::path data = test::data_folder();
  if (!std::filesystem::is_directory(data)) GTEST_SKIP() << "no real snapshots in " << data;
  const auto gadget = open_snapshot(data / "lcdm/fmt2_snapshot_005");
  ASSERT_TRUE(gadget->info().cosmology);
  EXPECT_EQ(gadget->info().cosmology->omega_lambda, 0.7);
  const auto swift = open_snapshot(data / "swift/swift_lcdm_0000.hdf5");
  ASSERT_TRUE(swift->info().cosmology);
  // Mpc without h and km/s, with h = 0.7; peculiar velocities; the file says 69.99999997.
  EXPECT_NEAR(swift->info().cosmology->hubble_rate, 70, 1e-5);
  EXPECT_EQ(swift->info().cosmology->velocity_power, 0);
  EXPECT_NEAR(swift->info().cosmology->scale_factor, 0.98, 1e-9);
  EXPECT_FALSE(open_snapshot(data / "galaxy_collision/snapshot_005.hdf5")->info().cosmology);
  EXPECT_FALSE(open_snapshot(data / "gassphere/fmt2_snapshot_004")->info().cosmology);
}

}  // namespace
}  // namespace splotchcl
