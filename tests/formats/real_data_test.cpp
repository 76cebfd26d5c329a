// Real snapshots of public codes. What is expected of them was found with other programs.
#include "formats/snapshot_checks.h"
#include "real_snapshots.h"
#include "scene/statistics.h"
#include "smoothing/smoothing_lengths.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

class RealSnapshots : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory(data_)) {
      GTEST_SKIP() << "no real snapshots in " << data_ << " (see SPLOTCHCL_TEST_DATA)";
    }
  }
  std::unique_ptr<Snapshot> open(const std::string& name) const {
    return open_snapshot(data_ / name);
  }
  const std::filesystem::path data_ = test::data_folder();
};

std::size_t bad_values(const Snapshot& snapshot) {
  std::size_t bad = 0;
  for (const ParticleTypeInfo& type : snapshot.info().types) {
    for (const FieldInfo& field : type.fields) {
      bad += find_statistics(snapshot.read(type.type, field.name)).bad;
    }
  }
  return bad;
}

TEST_F(RealSnapshots, AreAllReadByAnyOfTheirNames) {
  std::vector<std::string> names = real_snapshots();
  names.insert(names.end(),
               {"gadget_minimal", "gadget_minimal/snap_002", "swift", "phantom",
                "gassphere_multifile/fmt1_snapshot_002", "gassphere_multifile/fmt2_snapshot_002",
                "gassphere_multifile/fmt3_snapshot_002"});
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    const auto snapshot = open(name);
    EXPECT_FALSE(snapshot->info().types.empty());
    for (const ParticleTypeInfo& type : snapshot->info().types)
      EXPECT_EQ(find_statistics(snapshot->read(type.type, "position")).bad, 0U);
  }
}

TEST_F(RealSnapshots, CosmologicalBoxIsTheSameInAllFormats) {
  const auto format1 = open("lcdm/fmt1_snapshot_006");
  const auto format2 = open("lcdm/fmt2_snapshot_006");
  const auto hdf5 = open("lcdm/fmt3_snapshot_006.hdf5");
  expect_same_columns(*format1, *format2);
  expect_same_columns(*hdf5, *format2);
  EXPECT_EQ(format2->info().box_size, 50000);
  EXPECT_EQ(format2->info().redshift, hdf5->info().redshift);
  ASSERT_EQ(format2->info().types.size(), 2U);
  EXPECT_EQ(format2->info().types[1].count, 32768U);
  EXPECT_EQ(bad_values(*format2), 0U);
}

TEST_F(RealSnapshots, CosmologicalBoxHasItsValues) {
  const auto snapshot = open("lcdm/fmt2_snapshot_006");
  EXPECT_EQ(snapshot->read(0, "POS")[0], 1523.1517333984375F);
  const FieldStatistics density = find_statistics(snapshot->read(0, "density"));
  EXPECT_EQ(static_cast<float>(density.maximum), 1.9827355e-06F);
  EXPECT_EQ(snapshot->read(1, "mass").uniform_value(), 27.52799650181371F);
}

TEST_F(RealSnapshots, CollapseIsTheSameInAllFormats) {
  for (const std::string time : {"000", "004", "008"}) {
    const auto format1 = open("gassphere/fmt1_snapshot_" + time);
    const auto format2 = open("gassphere/fmt2_snapshot_" + time);
    const auto hdf5 = open("gassphere/fmt3_snapshot_" + time + ".hdf5");
    expect_same_columns(*format1, *format2);
    expect_same_columns(*hdf5, *format2);
    EXPECT_EQ(format2->info().redshift, std::nullopt);
    EXPECT_EQ(format2->info().box_size, std::nullopt);
  }
}

TEST_F(RealSnapshots, SetsOfThreeFilesAreTheSameInAllFormats) {
  const auto format1 = open("gassphere_multifile/fmt1_snapshot_002");
  const auto format2 = open("gassphere_multifile/fmt2_snapshot_002.1");
  const auto hdf5 = open("gassphere_multifile/fmt3_snapshot_002");
  EXPECT_EQ(format2->info().files.size(), 3U);
  EXPECT_EQ(format2->info().types[0].count, 1472U);
  expect_same_columns(*format1, *format2);
  expect_same_columns(*hdf5, *format2);
}

TEST_F(RealSnapshots, LongIdentifiersAndFurtherBlocksAreRead) {
  const auto format1 = open("gassphere_id64/fmt1_snapshot_001");
  const auto format2 = open("gassphere_id64/fmt2_snapshot_001");
  const auto hdf5 = open("gassphere_id64/fmt3_snapshot_001.hdf5");
  expect_same_columns(*hdf5, *format2);
  EXPECT_EQ(find_statistics(format2->read(0, "id")).minimum, 8589934592.0);
  EXPECT_EQ(values_of(format1->read(0, "block_8")), values_of(format2->read(0, "POT")));
  EXPECT_EQ(values_of(format1->read(0, "block_9")), values_of(hdf5->read(0, "ACCE")));
}

TEST_F(RealSnapshots, InitialConditionsAreTheSameInBothEndiannesses) {
  const auto little = open("gadget2_ics/gassphere_littleendian.dat");
  const auto big = open("gadget2_ics/gassphere_bigendian.dat");
  expect_same_columns(*big, *little);
  EXPECT_EQ(big->info().format, "Gadget format 1, big-endian");
  EXPECT_EQ(big->info().types[0].count, 1472U);
}

TEST_F(RealSnapshots, InitialConditionsWithoutGasAndWithoutDensitiesAreRead) {
  const auto galaxy = open("gadget2_ics/galaxy_littleendian.dat");
  EXPECT_EQ(galaxy->info().find_type(1)->count, 40000U);
  EXPECT_EQ(galaxy->info().find_type(2)->count, 20000U);
  EXPECT_TRUE(galaxy->read(2, "mass").is_uniform());
  const auto box = open("gadget2_ics/lcdm_gas_littleendian.dat");
  EXPECT_EQ(box->info().redshift, 10);
  EXPECT_EQ(box->info().box_size, std::nullopt);
  EXPECT_FALSE(has_field(*box, 0, "density"));
  EXPECT_TRUE(has_field(*box, 0, "internal_energy"));
}

TEST_F(RealSnapshots, GalaxyCollisionOfGadget4IsRead) {
  for (const std::string time : {"000", "005", "010"}) {
    const auto snapshot = open("galaxy_collision/snapshot_" + time + ".hdf5");
    EXPECT_EQ(snapshot->info().find_type(1)->count, 40000U);
    EXPECT_EQ(snapshot->info().find_type(2)->count, 20000U);
    EXPECT_EQ(snapshot->info().types[0].fields[0].unit, "kpc");
    EXPECT_EQ(snapshot->info().redshift, std::nullopt);
    EXPECT_EQ(bad_values(*snapshot), 0U);
  }
}

TEST_F(RealSnapshots, AFolderOfFilesWithFewBlocksIsRead) {
  const auto snapshot = open("gadget_minimal");
  EXPECT_EQ(snapshot->info().files.size(), 4U);
  EXPECT_EQ(snapshot->info().find_type(0)->count, 400U);
  EXPECT_EQ(snapshot->read(0, "mass").size(), 400U);
  EXPECT_EQ(snapshot->read(1, "mass").uniform_value(), 0.1F);
  EXPECT_FALSE(has_field(*snapshot, 0, "velocity"));
  EXPECT_FALSE(has_field(*snapshot, 0, "id"));
}

TEST_F(RealSnapshots, BrokenFilesAreRefusedWithWhatIsWrong) {
  EXPECT_THAT(refusal(data_ / "broken/no_positions/snap_144.0.key"),
              HasSubstr("no positions: the file has only INFO, KEY, NKEY, OKEY"));
}

TEST_F(RealSnapshots, ATypeWithoutCoordinatesIsLeftOut) {
  const auto snapshot = open("broken/no_coordinates.hdf5");
  EXPECT_EQ(snapshot->info().types.size(), 1U);
  EXPECT_EQ(snapshot->info().find_type(1)->count, 9261U);
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("PartType0 is left out")));
}

TEST_F(RealSnapshots, SwiftIsReadWithTheSupportOfItsKernel) {
  const auto snapshot = open("swift/swift_lcdm_0000.hdf5");
  EXPECT_EQ(snapshot->info().format, "SWIFT HDF5");
  EXPECT_NEAR(snapshot->info().box_size->longest(), 71.428571, 1e-6);
  EXPECT_NE(snapshot->position_origin().a[0], 0);
  // SWIFT chooses h so that 47.99508 particles' mass is within the kernel's support, to a
  // tolerance of 1e-4 in h, so 3e-4 in the volume.
  const Column h = snapshot->read(0, "smoothing_length");
  const Column density = snapshot->read(0, "density");
  const Column mass = snapshot->read(0, "mass");
  std::vector<double> neighbors;
  for (std::size_t i = 0; i < h.size(); ++i) {
    const double length = static_cast<double>(h[i]);
    neighbors.push_back(4 * M_PI / 3 * length * length * length * static_cast<double>(density[i]) /
                        static_cast<double>(mass[i]));
  }
  std::nth_element(neighbors.begin(), neighbors.begin() + 16384, neighbors.end());
  EXPECT_NEAR(neighbors[16384], 47.99508, 47.99508 * 3e-4);
}

TEST_F(RealSnapshots, LengthsFromDensityAreNearThoseOfTheFile) {
  const auto snapshot = open("lcdm/fmt2_snapshot_006");
  const Column own = snapshot->read(0, "smoothing_length");
  const Column found = smoothing_lengths_from_density(snapshot->read(0, "mass"),
                                                      snapshot->read(0, "density"), own.size(), 33);
  std::vector<double> ratios;
  for (std::size_t i = 0; i < own.size(); ++i) {
    ratios.push_back(static_cast<double>(found[i]) / static_cast<double>(own[i]));
  }
  std::nth_element(ratios.begin(), ratios.begin() + 16384, ratios.end());
  // The run asked for 33 +- 2 neighbours: a third of 2/33 in the length.
  EXPECT_NEAR(ratios[16384], 1, 2.0 / 33 / 3);
}

}  // namespace
}  // namespace splotchcl::test
