#include "formats/hdf5/hdf5_units.h"
#include "formats/hdf5/hdf5_values.h"
#include "formats/hdf5/snapshot_hdf5_writer.h"
#include "formats/snapshot_rows.h"

namespace splotchcl::test {
namespace {

struct NamedStyle {
  const char* name;
  Hdf5Style style;
};
class GadgetHdf5Styles : public ::testing::TestWithParam<NamedStyle> {};
INSTANTIATE_TEST_SUITE_P(
    Style, GadgetHdf5Styles,
    ::testing::Values(NamedStyle{"Plain", {}},
                      NamedStyle{"Compressed", {true, false, false, false, 6}},
                      NamedStyle{"ArrayScalars", {false, true, false, false, 6}},
                      NamedStyle{"DoubleCounts", {false, false, true, false, 6}},
                      NamedStyle{"Gadget4", {true, false, false, true, 5}},
                      NamedStyle{"SevenTypes", {true, true, false, true, 7}}),
    [](const auto& info) { return info.param.name; });

TEST_P(GadgetHdf5Styles, HasTheColumnsOfTheSameStateInFormat2) {
  const TemporaryFolder folder;
  write_hdf5(folder / "snap.hdf5", small_snapshot(), GetParam().style);
  write_gadget(folder / "snap", small_snapshot(), 2);
  const auto hdf5 = open_snapshot(folder / "snap.hdf5");
  const auto binary = open_snapshot(folder / "snap");
  expect_same_columns(*hdf5, *binary);
  EXPECT_EQ(hdf5->info().format, "Gadget HDF5");
  EXPECT_EQ(hdf5->info().time, binary->info().time);
  EXPECT_EQ(hdf5->info().redshift, binary->info().redshift);
  EXPECT_EQ(hdf5->info().box_size, binary->info().box_size);
  EXPECT_EQ(hdf5->info().hubble_parameter, binary->info().hubble_parameter);
}

class GadgetHdf5 : public ::testing::Test {
 protected:
  void write(const TestSnapshot& snapshot, const Hdf5Style& style = {}) const {
    write_hdf5(path_, snapshot, style);
  }
  Hdf5Handle<H5Fclose> changed(const std::filesystem::path& path) const {
    return Hdf5Handle<H5Fclose>(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT));
  }
  const TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "snap.hdf5";
};

// Its files are opened again for each column.
TEST_F(GadgetHdf5, WhoseFileIsAnotherThanWhenItWasOpenedIsAnError) {
  write(small_snapshot());
  const auto held = open_snapshot(path_);
  write_hdf5(folder_ / "other.hdf5", small_snapshot());
  std::filesystem::rename(folder_ / "other.hdf5", path_);
  EXPECT_THAT([&] { held->read(0, "position"); },
              ThrowsMessage<DataError>(HasSubstr("since it was opened; open it again")));
  EXPECT_NO_THROW(open_snapshot(path_)->read(0, "position"));
}

TEST_F(GadgetHdf5, StatesTheUnitsThatTheFileStates) {
  write(small_snapshot());
  expect_snapshot(path_, {}, "unit position ");
  Hdf5Style style;
  style.has_parameters_group = true;
  write(small_snapshot(), style);
  expect_snapshot(path_, {}, "unit position kpc");
}

TEST_F(GadgetHdf5, DoublePositionsKeepTheirDigits) {
  Hdf5Style compressed;
  compressed.is_compressed = true;
  const TestSnapshot written = of_doubles_far_away(small_snapshot());
  write(written, compressed);
  expect_positions_of(*open_snapshot(path_), written);
}

TEST_F(GadgetHdf5, DoublesOfTheSameStateAreTheSameInFormat2) {
  TestSnapshot written = small_snapshot();
  for (const char* label : {"POS", "VEL", "MASS", "U"}) {
    written.set_kind(label, ValueKind::float64);
    for (auto& of_type : written.block(label).values) {
      for (double& x : of_type)
        x *= 1.0000001;
    }
  }
  write(written);
  write_gadget(folder_ / "snap", written, 2);
  const auto hdf5 = open_snapshot(path_);
  const auto binary = open_snapshot(folder_ / "snap");
  EXPECT_EQ(hdf5->position_origin().a[0], binary->position_origin().a[0]);
  expect_same_columns(*hdf5, *binary);
}

TEST_F(GadgetHdf5, DatasetsLongerThanAPieceAreReadWhole) {
  TestSnapshot written;
  written.counts[1] = 2500000;  // a piece has 2^20 rows
  written.table_masses[1] = 1;
  add_block(written, "POS", 2U, 3);
  for (double& x : written.block("POS").values[1])
    x = static_cast<float>(x);
  written.set_kind("POS", ValueKind::float64);
  write(written);
  const auto snapshot = open_snapshot(path_);
  const Column positions = snapshot->read(1, "position");
  const Vec3 origin = snapshot->position_origin();
  const auto& expected = written.block("POS").values[1];
  ASSERT_EQ(positions.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_EQ(positions[i], static_cast<float>(expected[i] - origin.a[i % 3])) << i;
  }
}

TEST_F(GadgetHdf5, TruncatedFilesAreRefusedWithoutPrinting) {
  write_hdf5(folder_ / "whole.hdf5", small_snapshot());
  const std::string whole = read_text(folder_ / "whole.hdf5");
  ::testing::internal::CaptureStderr();
  for (std::size_t size = 0; size < whole.size(); size += size < 200 ? 1 : 97) {
    write_bytes(path_, whole.substr(0, size));
    EXPECT_NE(refusal(path_), "") << "cut to " << size << " bytes";
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST_F(GadgetHdf5, RowsCountWhereTheHeaderClaimsOtherNumbersOfParticles) {
  write_hdf5(folder_ / "right.hdf5", small_snapshot());
  for (const int change : {-1, 1, 1000000, -37}) {
    TestSnapshot snapshot = small_snapshot();
    snapshot.counts[0] = static_cast<std::uint32_t>(37 + change);
    write(snapshot);
    const auto opened = open_snapshot(path_);
    expect_same_columns(*opened, *open_snapshot(folder_ / "right.hdf5"));
    EXPECT_THAT(opened->info().notes, Contains(HasSubstr("has 37 rows: these count"))) << change;
  }
}

TEST_F(GadgetHdf5, ATypeWithoutPositionsOrGroupIsLeftOut) {
  TestSnapshot snapshot = small_snapshot();
  snapshot.block("POS").values[4].clear();
  snapshot.counts[3] = 5;
  write(snapshot);
  expect_snapshot(path_, {},
                  "types 2 | note 11 particles, but it has no positions | "
                  "note 5 particles, but there is no such group");
  EXPECT_EQ(open_snapshot(path_)->info().find_type(4), nullptr);
}

TEST_F(GadgetHdf5, OfTypesThatAreAllLeftOutIsRefused) {
  TestSnapshot snapshot = small_snapshot();
  for (std::vector<double>& positions : snapshot.block("POS").values)
    positions.clear();
  write(snapshot);
  expect_snapshot(path_, {}, "refused no positions | refused 37 particles of PartType0");
}

TEST_F(GadgetHdf5, FieldsOfManyWidthsAreLeftOutWithANote) {
  TestSnapshot snapshot = small_snapshot();
  add_block(snapshot, "Elements", 1U, 65);
  write(snapshot);
  expect_snapshot(path_, {}, "no Elements/0 | note left out of PartType0");
}

TEST_F(GadgetHdf5, ADatasetThatWasNeverWrittenIsRefusedWithoutClaimingItsMemory) {
  TestSnapshot snapshot;
  snapshot.counts[1] = 4000000000U;
  snapshot.table_masses[1] = 1;
  write(snapshot);
  {  // 4 billion particles that exist as a shape only
    const Hdf5Handle<H5Fclose> file = changed(path_);
    const Hdf5Handle<H5Gclose> group(
        H5Gcreate2(file.id(), "PartType1", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    const hsize_t shape[2] = {4000000000U, 3}, chunk[2] = {65536, 3};
    const Hdf5Handle<H5Sclose> space(H5Screate_simple(2, shape, nullptr));
    const Hdf5Handle<H5Pclose> properties(H5Pcreate(H5P_DATASET_CREATE));
    H5Pset_chunk(properties.id(), 2, chunk);
    const Hdf5Handle<H5Dclose> dataset(H5Dcreate2(group.id(), "Coordinates", H5T_IEEE_F32LE,
                                                  space.id(), H5P_DEFAULT, properties.id(),
                                                  H5P_DEFAULT));
  }
  expect_snapshot(path_, {}, "unreadable not completely written");
}

TEST_F(GadgetHdf5, PositionsThatEachFileOfASetNamesDifferentlyAreRefused) {
  const auto members = split(small_snapshot(), 2);
  write_hdf5(folder_ / "snap.0.hdf5", members[0]);
  write_hdf5(folder_ / "snap.1.hdf5", members[1]);
  {
    const Hdf5Handle<H5Fclose> file = changed(folder_ / "snap.1.hdf5");
    H5Lmove(file.id(), "PartType0/Coordinates", file.id(), "PartType0/Positions", H5P_DEFAULT,
            H5P_DEFAULT);
  }
  EXPECT_THAT(refusal(folder_ / "snap.0.hdf5"), HasSubstr("type 0 have no positions"));
}

TEST_F(GadgetHdf5, SwiftWithoutItsKernelIsNoted) {
  write(small_snapshot());
  {
    const Hdf5Handle<H5Fclose> file = changed(path_);
    const Hdf5Handle<H5Tclose> text(H5Tcopy(H5T_C_S1));
    H5Tset_size(text.id(), 5);
    const Hdf5Handle<H5Sclose> one(H5Screate(H5S_SCALAR));
    const Hdf5Handle<H5Aclose> code(H5Acreate_by_name(
        file.id(), "Header", "Code", text.id(), one.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    H5Awrite(code.id(), text.id(), "SWIFT");
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_EQ(snapshot->info().format, "SWIFT HDF5");
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("Kernel gamma")));
  EXPECT_FLOAT_EQ(snapshot->read(0, "smoothing_length")[0],
                  static_cast<float>(small_snapshot().block("HSML").values[0][0] * 1.825742));
}

// The gas of `source`, as SWIFT writes it beside the parts of a snapshot.
void write_virtual(const std::filesystem::path& path, const std::filesystem::path& source,
                   const TestSnapshot& snapshot) {
  write_hdf5(path, snapshot);
  const Hdf5Handle<H5Fclose> file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT));
  H5Ldelete(file.id(), "PartType0/Coordinates", H5P_DEFAULT);
  const hsize_t shape[2] = {snapshot.counts[0], 3};
  const Hdf5Handle<H5Sclose> space(H5Screate_simple(2, shape, nullptr));
  const Hdf5Handle<H5Pclose> properties(H5Pcreate(H5P_DATASET_CREATE));
  H5Pset_virtual(properties.id(), space.id(), source.filename().c_str(), "PartType0/Coordinates",
                 space.id());
  const Hdf5Handle<H5Dclose> dataset(H5Dcreate2(file.id(), "PartType0/Coordinates", H5T_IEEE_F32LE,
                                                space.id(), H5P_DEFAULT, properties.id(),
                                                H5P_DEFAULT));
}

TEST_F(GadgetHdf5, VirtualDatasetsAreReadFromTheirFiles) {
  TestSnapshot snapshot = small_snapshot();
  write_hdf5(folder_ / "part", snapshot);
  write_virtual(path_, folder_ / "part", snapshot);
  EXPECT_EQ(values_of(open_snapshot(path_)->read(0, "position")),
            as_floats(snapshot.block("POS").values[0]));
}

TEST_F(GadgetHdf5, AVirtualDatasetWithoutItsFileIsRefused) {
  write_virtual(path_, folder_ / "part", small_snapshot());
  expect_snapshot(path_, {}, "unreadable part, which is missing");
}

TEST_F(GadgetHdf5, AnHdf5FileOfAnotherKindIsRefusedWithItsGroups) {
  make_group(create_hdf5(path_), "spectra");
  expect_snapshot(path_, {}, "refused NumPart_ThisFile | refused spectra");
}

TEST(UnitNames, AreComposedOfTheNamesThatPeopleUse) {
  const BaseUnits gadget = {3.085678e21, 1.989e43, 1e5};
  UnitPowers density;
  density.mass = 1;
  density.length = -3;
  density.hubble = 2;
  EXPECT_EQ(unit_name(density, gadget), "1e10 M_sun kpc^-3 h^2");
  UnitPowers energy;
  energy.velocity = 2;
  EXPECT_EQ(unit_name(energy, gadget), "(km/s)^2");
}

TEST(UnitNames, OfAnUnnamedUnitIsItsSize) {
  UnitPowers length;
  length.length = 1;
  EXPECT_EQ(unit_name(length, {2.5e20, 1, 1}), "2.5e+20 cm");
}

TEST(UnitNames, AreEmptyWhereTheFileSaysNothing) {
  UnitPowers length;
  length.length = 1;
  EXPECT_EQ(unit_name(length, {}), "");
  EXPECT_EQ(unit_name({}, {3.085678e21, 1.989e43, 1e5}), "");
}

}  // namespace
}  // namespace splotchcl::test
