#include <hdf5.h>

#include "formats/hdf5/hdf5_file.h"
#include "formats/hdf5/snapshot_hdf5_writer.h"
#include "formats/snapshot_checks.h"
#include "formats/snapshot_writer.h"
#include "splotchcl/snapshot_file.h"

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

// Its files are opened again for each column.
TEST(GadgetHdf5, WhoseFileIsAnotherThanWhenItWasOpenedIsAnError) {
  const TemporaryFolder folder;
  write_hdf5(folder / "snap.hdf5", small_snapshot());
  const auto held = open_snapshot(folder / "snap.hdf5");
  write_hdf5(folder / "other.hdf5", small_snapshot());
  std::filesystem::rename(folder / "other.hdf5", folder / "snap.hdf5");
  EXPECT_THAT([&] { held->read(0, "position"); },
              ThrowsMessage<DataError>(HasSubstr("since it was opened; open it again")));
  EXPECT_NO_THROW(open_snapshot(folder / "snap.hdf5")->read(0, "position"));
}

TEST(GadgetHdf5, StatesTheUnitsThatTheFileStates) {
  const TemporaryFolder folder;
  Hdf5Style style;
  style.has_parameters_group = true;
  write_hdf5(folder / "with.hdf5", small_snapshot(), style);
  write_hdf5(folder / "without.hdf5", small_snapshot());
  const auto position_unit = [&](const std::string& name) {
    const auto snapshot = open_snapshot(folder / name);
    for (const FieldInfo& field : snapshot->info().types[0].fields) {
      if (field.name == "position") return field.unit;
    }
    return std::string("no positions");
  };
  EXPECT_EQ(position_unit("with.hdf5"), "kpc");
  EXPECT_EQ(position_unit("without.hdf5"), "");
}

TEST(GadgetHdf5, DoublePositionsKeepTheirDigits) {
  const TemporaryFolder folder;
  TestSnapshot written = small_snapshot();
  written.set_kind("POS", ValueKind::float64);
  for (auto& of_type : written.block("POS").values) {
    for (double& x : of_type)
      x += 1e6 + 1e-7;
  }
  Hdf5Style compressed;
  compressed.is_compressed = true;
  write_hdf5(folder / "snap.hdf5", written, compressed);
  const auto snapshot = open_snapshot(folder / "snap.hdf5");
  const Vec3 origin = snapshot->position_origin();
  for (const int type : {0, 1, 4}) {
    const auto& expected = written.block("POS").values[static_cast<std::size_t>(type)];
    const Column positions = snapshot->read(type, "position");
    ASSERT_EQ(positions.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      // Offsets from the median are below 64, where floats lie 2^-18 apart.
      EXPECT_NEAR(origin.a[i % 3] + static_cast<double>(positions[i]), expected[i], 0x1p-18);
    }
  }
}

TEST(GadgetHdf5, DoublesOfTheSameStateAreTheSameInFormat2) {
  const TemporaryFolder folder;
  TestSnapshot written = small_snapshot();
  for (const char* label : {"POS", "VEL", "MASS", "U"}) {
    written.set_kind(label, ValueKind::float64);
    for (auto& of_type : written.block(label).values) {
      for (double& x : of_type)
        x *= 1.0000001;
    }
  }
  write_hdf5(folder / "snap.hdf5", written);
  write_gadget(folder / "snap", written, 2);
  const auto hdf5 = open_snapshot(folder / "snap.hdf5");
  const auto binary = open_snapshot(folder / "snap");
  EXPECT_EQ(hdf5->position_origin().a[0], binary->position_origin().a[0]);
  expect_same_columns(*hdf5, *binary);
}

TEST(GadgetHdf5, DatasetsLongerThanAPieceAreReadWhole) {
  const TemporaryFolder folder;
  TestSnapshot written;
  written.counts[1] = 2500000;  // a piece has 2^20 rows
  written.table_masses[1] = 1;
  add_block(written, "POS", 2U, 3);
  for (double& x : written.block("POS").values[1])
    x = static_cast<float>(x);
  written.set_kind("POS", ValueKind::float64);
  write_hdf5(folder / "snap.hdf5", written);
  const auto snapshot = open_snapshot(folder / "snap.hdf5");
  const Column positions = snapshot->read(1, "position");
  const Vec3 origin = snapshot->position_origin();
  const auto& expected = written.block("POS").values[1];
  ASSERT_EQ(positions.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_EQ(positions[i], static_cast<float>(expected[i] - origin.a[i % 3])) << i;
  }
}

TEST(GadgetHdf5, TruncatedFilesAreRefusedWithoutPrinting) {
  const TemporaryFolder folder;
  write_hdf5(folder / "whole.hdf5", small_snapshot());
  const std::string whole = read_text(folder / "whole.hdf5");
  ::testing::internal::CaptureStderr();
  for (std::size_t size = 0; size < whole.size(); size += size < 200 ? 1 : 97) {
    write_bytes(folder / "snap.hdf5", whole.substr(0, size));
    EXPECT_NE(refusal(folder / "snap.hdf5"), "") << "cut to " << size << " bytes";
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(GadgetHdf5, RowsCountWhereTheHeaderClaimsOtherNumbersOfParticles) {
  const TemporaryFolder folder;
  write_hdf5(folder / "right.hdf5", small_snapshot());
  for (const int change : {-1, 1, 1000000, -37}) {
    TestSnapshot snapshot = small_snapshot();
    snapshot.counts[0] = static_cast<std::uint32_t>(37 + change);
    write_hdf5(folder / "snap.hdf5", snapshot);
    const auto opened = open_snapshot(folder / "snap.hdf5");
    expect_same_columns(*opened, *open_snapshot(folder / "right.hdf5"));
    EXPECT_THAT(opened->info().notes, Contains(HasSubstr("has 37 rows: these count"))) << change;
  }
}

TEST(GadgetHdf5, ATypeWithoutPositionsOrGroupIsLeftOut) {
  const TemporaryFolder folder;
  TestSnapshot snapshot = small_snapshot();
  snapshot.block("POS").values[4].clear();
  snapshot.counts[3] = 5;
  write_hdf5(folder / "snap.hdf5", snapshot);
  const auto opened = open_snapshot(folder / "snap.hdf5");
  EXPECT_EQ(opened->info().find_type(4), nullptr);
  EXPECT_THAT(opened->info().notes,
              AllOf(Contains(HasSubstr("11 particles, but it has no positions")),
                    Contains(HasSubstr("5 particles, but there is no such group"))));
}

TEST(GadgetHdf5, OfTypesThatAreAllLeftOutIsRefused) {
  const TemporaryFolder folder;
  TestSnapshot snapshot = small_snapshot();
  for (std::vector<double>& positions : snapshot.block("POS").values)
    positions.clear();
  write_hdf5(folder / "snap.hdf5", snapshot);
  EXPECT_THAT(refusal(folder / "snap.hdf5"),
              AllOf(HasSubstr("no positions"), HasSubstr("37 particles of PartType0")));
}

TEST(GadgetHdf5, FieldsOfManyWidthsAreLeftOutWithANote) {
  const TemporaryFolder folder;
  TestSnapshot snapshot = small_snapshot();
  add_block(snapshot, "Elements", 1U, 65);
  write_hdf5(folder / "snap.hdf5", snapshot);
  const auto opened = open_snapshot(folder / "snap.hdf5");
  EXPECT_FALSE(has_field(*opened, 0, "Elements"));
  EXPECT_THAT(opened->info().notes, Contains(HasSubstr("left out of PartType0")));
}

TEST(GadgetHdf5, ADatasetThatWasNeverWrittenIsRefusedWithoutClaimingItsMemory) {
  const TemporaryFolder folder;
  TestSnapshot snapshot;
  snapshot.counts[1] = 4000000000U;
  snapshot.table_masses[1] = 1;
  write_hdf5(folder / "snap.hdf5", snapshot);
  {  // 4 billion particles that exist as a shape only
    const Hdf5Handle<H5Fclose> file(
        H5Fopen((folder / "snap.hdf5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT));
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
  const auto opened = open_snapshot(folder / "snap.hdf5");
  EXPECT_THAT([&] { opened->read(1, "position"); },
              ThrowsMessage<DataError>(HasSubstr("not completely written")));
}

TEST(GadgetHdf5, PositionsThatEachFileOfASetNamesDifferentlyAreRefused) {
  const TemporaryFolder folder;
  const auto members = split(small_snapshot(), 2);
  write_hdf5(folder / "snap.0.hdf5", members[0]);
  write_hdf5(folder / "snap.1.hdf5", members[1]);
  {
    const Hdf5Handle<H5Fclose> file(
        H5Fopen((folder / "snap.1.hdf5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT));
    H5Lmove(file.id(), "PartType0/Coordinates", file.id(), "PartType0/Positions", H5P_DEFAULT,
            H5P_DEFAULT);
  }
  EXPECT_THAT(refusal(folder / "snap.0.hdf5"), HasSubstr("type 0 have no positions"));
}

TEST(GadgetHdf5, SwiftWithoutItsKernelIsNoted) {
  const TemporaryFolder folder;
  write_hdf5(folder / "snap.hdf5", small_snapshot());
  {
    const Hdf5Handle<H5Fclose> file(
        H5Fopen((folder / "snap.hdf5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT));
    const Hdf5Handle<H5Tclose> text(H5Tcopy(H5T_C_S1));
    H5Tset_size(text.id(), 5);
    const Hdf5Handle<H5Sclose> one(H5Screate(H5S_SCALAR));
    const Hdf5Handle<H5Aclose> code(H5Acreate_by_name(
        file.id(), "Header", "Code", text.id(), one.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    H5Awrite(code.id(), text.id(), "SWIFT");
  }
  const auto snapshot = open_snapshot(folder / "snap.hdf5");
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

TEST(GadgetHdf5, VirtualDatasetsAreReadFromTheirFiles) {
  const TemporaryFolder folder;
  TestSnapshot snapshot = small_snapshot();
  write_hdf5(folder / "part", snapshot);
  write_virtual(folder / "snap.hdf5", folder / "part", snapshot);
  EXPECT_EQ(values_of(open_snapshot(folder / "snap.hdf5")->read(0, "position")),
            as_floats(snapshot.block("POS").values[0]));
}

TEST(GadgetHdf5, AVirtualDatasetWithoutItsFileIsRefused) {
  const TemporaryFolder folder;
  write_virtual(folder / "snap.hdf5", folder / "part", small_snapshot());
  const auto snapshot = open_snapshot(folder / "snap.hdf5");
  EXPECT_THAT([&] { snapshot->read(0, "position"); },
              ThrowsMessage<DataError>(HasSubstr("part, which is missing")));
}

TEST(GadgetHdf5, AnHdf5FileOfAnotherKindIsRefusedWithItsGroups) {
  const TemporaryFolder folder;
  {
    const Hdf5Handle<H5Fclose> file(
        H5Fcreate((folder / "data.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
    const Hdf5Handle<H5Gclose> group(
        H5Gcreate2(file.id(), "spectra", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  }
  EXPECT_THAT(refusal(folder / "data.h5"),
              AllOf(HasSubstr("NumPart_ThisFile"), HasSubstr("spectra")));
}

}  // namespace
}  // namespace splotchcl::test
