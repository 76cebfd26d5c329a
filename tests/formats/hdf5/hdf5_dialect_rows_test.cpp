// Headers and rows that do not agree.
#include "formats/hdf5/hdf5_dialects.h"
#include "formats/snapshot_checks.h"
#include "snapshot/field_names.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST_F(Hdf5Dialects, TracersWithoutPositionsAreLeftOutWithANote) {
  {
    const Hdf5Output file = create({2, 0, 0, 3, 0, 0});
    write_attribute(file, "Header", "NumPart_Total", {2, 0, 0, 3, 0, 0});
    write_values(file, "PartType3/TracerID", {1, 2, 3}, 1, H5T_STD_U64LE);
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_EQ(snapshot->info().types.size(), 1U);
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("tracers of PartType3")));
}

TEST_F(Hdf5Dialects, CountsOfZeroOrNonsenseInTheHeaderAreTakenFromTheRows) {
  for (const std::vector<double>& counts :
       {std::vector<double>{0, 0, 0, 0, 0, 0}, {-1, 0, 0, 0, 0, 0}, {1e300, 0.5}, {0}}) {
    create(counts);
    const auto snapshot = open_snapshot(path_);
    EXPECT_EQ(snapshot->info().find_type(0)->count, 2U);
    EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("those of the rows of the positions")));
  }
}

TEST_F(Hdf5Dialects, RowsCountWhereTheHeaderClaimsMoreOrFewer) {
  for (const double count : {1.0, 3.0, 1e15}) {
    create({count, 0, 0, 0, 0, 0});
    const auto snapshot = open_snapshot(path_);
    EXPECT_EQ(snapshot->info().find_type(0)->count, 2U);
    EXPECT_EQ(snapshot->read(0, "position").size(), 6U);
    EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("Coordinates has 2 rows: these count")));
  }
}

TEST_F(Hdf5Dialects, RowsOfATypeThatTheHeaderDoesNotCountAreParticles) {
  {
    const Hdf5Output file = create();
    write_values(file, "PartType6/Coordinates", {7, 8, 9}, 3);
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_EQ(snapshot->info().find_type(6)->count, 1U);
  EXPECT_EQ(snapshot->read(6, "position")[0] + static_cast<float>(snapshot->position_origin().a[0]),
            7);
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("counts 0 particles of type 6")));
}

TEST_F(Hdf5Dialects, ATypeWithoutItsGroupIsLeftOutWithANote) {
  {
    const Hdf5Output file = create({2, 1157, 0, 0, 0, 0});
    write_attribute(file, "Header", "NumPart_Total", {2, 1157, 0, 0, 0, 0});
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_EQ(snapshot->info().types.size(), 1U);
  EXPECT_THAT(snapshot->info().notes,
              Contains(HasSubstr("counts 1157 particles, but there is no such group")));
}

TEST_F(Hdf5Dialects, ATypeWithoutPositionsIsLeftOutWithANote) {
  {
    const Hdf5Output file = create({2, 0, 0, 0, 3, 0});
    write_values(file, "PartType4/Masses", {1, 2, 3});
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_EQ(snapshot->info().types.size(), 1U);
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("PartType4 is left out")));
}

TEST_F(Hdf5Dialects, DatasetsOfOtherLengthsAreLeftOutWithANote) {
  {
    const Hdf5Output file = create();
    write_values(file, "PartType0/Center", {50, 51, 52});
    write_values(file, "PartType0/Masses", {4, 5});
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_FALSE(has_field(*snapshot, 0, "Center"));
  EXPECT_THAT(values_of(snapshot->read(0, "mass")), ElementsAre(4, 5));
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("other than 2 rows: Center (3)")));
}

TEST_F(Hdf5Dialects, AnEmptyDatasetOfAnAbsentTypeIsNoObstacle) {
  {
    const Hdf5Output file = create();
    make_group(file, "PartType5");
    const Hdf5Handle<H5Sclose> none(H5Screate(H5S_NULL));
    const Hdf5Handle<H5Dclose> dataset(H5Dcreate2(file.id(), "PartType5/Coordinates",
                                                  H5T_IEEE_F32LE, none.id(), H5P_DEFAULT,
                                                  H5P_DEFAULT, H5P_DEFAULT));
  }
  EXPECT_EQ(open_snapshot(path_)->info().types.size(), 1U);
}

TEST_F(Hdf5Dialects, TotalsThatAreNonsenseAreIgnoredWithANote) {
  {
    const Hdf5Output file = create();
    write_attribute(file, "Header", "NumPart_Total", {-2, 0, 0, 0, 0, 0});
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_EQ(snapshot->info().find_type(0)->count, 2U);
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("NumPart_Total holds -2")));
}

TEST_F(Hdf5Dialects, AHeaderOfArraysOfAnyLengthIsRead) {
  for (const std::size_t types : {1U, 2U, 7U, 20U}) {
    std::vector<double> counts(types, 0);
    counts[0] = 2;
    {
      const Hdf5Output file = create(counts);
      write_attribute(file, "Header", "Time", {0.5, 9, 9});
      write_attribute(file, "Header", "BoxSize", {64, 64, 64});
      write_attribute(file, "Header", "MassTable", {3});
    }
    const auto snapshot = open_snapshot(path_);
    EXPECT_EQ(snapshot->info().time, 0.5) << types;
    EXPECT_EQ(snapshot->info().box_size, 64) << types;
    EXPECT_EQ(snapshot->read(0, "mass").uniform_value(), 3) << types;
  }
}

TEST_F(Hdf5Dialects, FieldsThatTheHeaderDoesNotCountAndNoCoordinatesAreLeftOut) {
  {
    const Hdf5Output file = create();
    write_values(file, "PartType3/Masses", {1, 2});
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_EQ(snapshot->info().types.size(), 1U);
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("PartType3 is left out")));
}

TEST_F(Hdf5Dialects, CoordinatesOfOtherWidthsAreRefusedWithTheirs) {
  {
    const Hdf5Output file = create_hdf5(path_);
    make_group(file, "Header");
    write_attribute(file, "Header", "NumPart_ThisFile", {2});
    write_values(file, "PartType0/Coordinates", {1, 2, 3, 4}, 2);
  }
  EXPECT_THAT(refusal(path_), HasSubstr("only Coordinates of 2 columns"));
}

TEST_F(Hdf5Dialects, WithoutCoordinatesIsRefused) {
  {
    const Hdf5Output file = create_hdf5(path_);
    make_group(file, "Header");
    write_attribute(file, "Header", "NumPart_ThisFile", {2});
    write_values(file, "PartType0/Masses", {1, 2});
  }
  EXPECT_THAT(refusal(path_), HasSubstr("expected a dataset Coordinates"));
}

}  // namespace
}  // namespace splotchcl::test
