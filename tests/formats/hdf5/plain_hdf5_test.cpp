#include "formats/hdf5/described_hdf5.h"
#include "snapshot/field_names.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

class PlainHdf5 : public ::testing::Test {
 protected:
  const TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "particles.h5";
};

class DescribedHdf5 : public ::testing::TestWithParam<SnapshotRow> {};

TEST_P(DescribedHdf5, IsReadOrRefused) {
  const TemporaryFolder folder;
  for (const std::string& content : GetParam().contents) {
    SCOPED_TRACE(content);
    write_described_hdf5(folder / "particles.h5", content);
    expect_snapshot(folder / "particles.h5", GetParam().options, GetParam().expected);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Plain, DescribedHdf5,
    ::testing::ValuesIn(std::vector<SnapshotRow>{
        {"DatasetsAtTheRootAreRead",
         {"pos x3: 1 2 3 4 5 6 | mass: 7 8 | ids u64: 4294967297 2 | halo_masses: 1 2 3 | "
          "/@BoxSize: 64 | /@time: 0.5"},
         "format HDF5 without a header | count 2 | box 64 | time 0.5 | position 1 2 3 4 5 6 | "
         "mass 7 8 | ids 4294967297 2 | note halo_masses"},
        {"AxesOfTheirOwnAreJoined",
         {"x: 1 4 | y: 2 5 | z: 3 6 | rho: 7 8"},
         "position 1 2 3 4 5 6 | density 7 8"},
        {"SizesOfUnitsThatAttributesStateAreRead",
         {"Coordinates x3: 1 2 3 4 5 6 | Masses: 7 8 | Coordinates@CGSConversionFactor: "
          "3.085678e24 "
          "| Masses@to_cgs: 1.989e43 | Masses@h_scaling: -1"},
         "unit position Mpc | unit mass 1e10 M_sun h^-1"},
        {"TheOnlyRowsOfThreeArePositionsWhateverTheirName",
         {"dataset x3: 1 2 3 4 5 6 | velocities x3: 1 2 3 4 5 6"},
         "position 1 2 3 4 5 6 | note dataset /dataset is taken for the positions"},
        {"GroupsAreTypesByTheirNames",
         {"PartType0/Coordinates x3: 1 2 3 4 5 6 | dark_matter/pos x3: 7 8 9 | "
          "star/pos x3: 1 1 1 2 2 2 3 3 3 | all/pos x3: 7 8 9 | profile/radius: 7 8 9"},
         "types 3 | count/4 3 | position 1 2 3 4 5 6 | position/1 7 8 9 | "
         "note group /all is left out"},
        {"TypesInSeveralUnitsAreConverted",
         {"gas/pos x3: 1000 2000 3000 | gas/pos@units: \"kpc | gas/mass: 500 | "
          "gas/mass@units: \"kg | stars/pos x3: 1000 2000 3000 | stars/pos@units: \"pc | "
          "stars/mass: 500 | stars/mass@units: \"g"},
         "position 1000 2000 3000 | position/4 1 2 3 | mass 500 | mass/4 0.5 | "
         "note mass of type 4 is converted from g to kg"},
        {"GroupsOfOtherNamesAreTypesInTheirOrder",
         {"first/pos x3: 1 2 3 | second/pos x3: 7 8 9"},
         "position/1 7 8 9 | note the particles of /second are taken for type 1"},
        {"PackedNumbersAreUnpackedAndComplexOnesSaid",
         {"pos x3: 1 2 3 4 5 6 | mass i16: 100 250 | mass@scale_factor: 0.01 | "
          "mass@add_offset: 2 | psi of r, i: 1 2 3 4"},
         "mass 3 4.5 | note 2 particles: psi"},
        {"RecordsAndRowsOfOtherShapesAreRefusedForWhatTheyAre",
         {"pos x5: 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 | particles of x: 1 2 3 4"},
         "refused particles (4 records), pos (4 x 5) | refused read.columns = {x = "},
        {"NumbersOfOtherGroupsAreNoSteps",
         {"cloud_1/pos x3: 1 2 3 | cloud_2/pos x3: 4 5 6"},
         "types 2"},
        {"YtsNamesUnitsAndDomainAreUnderstood",
         {"/@data_type: \"yt_data_container | /@current_redshift: 2 | /@domain_left_edge: 0 0 0 | "
          "/@domain_right_edge: 64 64 64 | /@domain_right_edge_units: \"cm | "
          "PartType4/particle_position_x: 1 2 | PartType4/particle_position_x@units: \"cm | "
          "PartType4/particle_position_y: 1 2 | PartType4/particle_position_y@units: \"cm | "
          "PartType4/particle_position_z: 1 2 | PartType4/particle_position_z@units: \"cm | "
          "PartType4/particle_mass: 5 6 | PartType4/particle_index: 9007199254740991 10"},
         "format HDF5 by yt's save_as_dataset | redshift 2 | box 64 | position/4 1 1 1 2 2 2 | "
         "mass/4 5 6 | ids/4 9007199254740991 10 | unit position cm"},
        {"IdentifiersThatAreNotWholeAreRefused",
         {"pos x3: 1 2 3 4 5 6 | ids: 1 2.5"},
         "refused not one whole number"},
        {"IdentifiersMayBeWholeFloats",
         {"pos x3: 1 2 3 4 5 6 | ids: 9007199254740991 2"},
         "ids 9007199254740991 2"},
        {"ASingleMassIsThatOfAllParticles",
         {"pos x3: 1 2 3 4 5 6 | mass scalar: 2.5"},
         "mass 2.5 2.5"},
        {"AnAxisOfAnotherLengthIsNotTakenForZero",
         {"x: 1 4 | y: 2 5 | z: 3 6 9"},
         "refused z has not the 2 rows"},
        {"WhatOtherGroupsHaveOfAsManyParticlesIsSaid",
         {"where/pos x3: 1 2 3 4 5 6 | what/mass: 7 8 | what/other: 7 8 9"},
         "note left out of /what, which has no positions: mass;"},
        {"ATypeWithoutRowsIsLeftOut",
         {"gas/pos x3: 1 2 3 4 5 6 | stars/pos x3:"},
         "types 1 | note /stars is left out"},
        {"AHeaderThatCountsNothingIsNoObstacle",
         {"Header@Redshift: 3 | PartType1/Coordinates x3: 1 2 3 4 5 6"},
         "redshift 3 | count/1 2"},
        {"WithoutPositionsIsRefusedWithWhatIsExpected",
         {"mass: 1 2 3"},
         "refused no positions whose names tell what they are (it holds: mass (3))"},
        {"PositionsWithoutRowsAreRefused", {"pos x3:"}, "refused have no rows"},
        {"RecordsAreColumnsByTheNamesOfTheirMembers",
         {"particles of x, y, z, mass: 1 2 3 10 4 5 6 20"},
         "position 1 2 3 4 5 6 | mass 10 20"},
        {"RecordsOfEachTypeAreTypesByTheirNames",
         {"run/dark_matter of x, y, z: 1 2 3 | run/stars of x, y, z: 4 5 6 7 8 9"},
         "count/1 1 | position/4 4 5 6 7 8 9"},
        {"AxesOneAfterTheOtherAreRows",
         {"pos x4: 1 2 3 4 10 20 30 40 100 200 300 400 | mass: 5 6 7 8"},
         "position 1 10 100 2 20 200 3 30 300 4 40 400 | mass 5 6 7 8"},
        {"ThreeRowsOfThreeAreParticlesAndNoAxes",
         {"pos x3: 1 2 3 4 5 6 7 8 9"},
         "position 1 2 3 4 5 6 7 8 9"},
        {"GroupsOfAxesAreVectorsAtAnyDepth",
         {"run/7/gas/position/x: 1 4 | run/7/gas/position/y: 2 5 | run/7/gas/position/z: 3 6 | "
          "run/7/gas/velocity/x: 10 40 | run/7/gas/velocity/y: 20 50 | "
          "run/7/gas/velocity/z: 30 60 | run/7/gas/mass: 5 6"},
         "position 1 2 3 4 5 6 | velocity 10 20 30 40 50 60 | mass 5 6"},
        {"ColumnsOfVaexAreReadWithTheirUnits",
         {"table/columns/x/data: 1 2 | table/columns/x@unit: \"kpc | table/columns/y/data: 1 2 | "
          "table/columns/y@unit: \"kpc | table/columns/z/data: 1 2 | "
          "table/columns/z@unit: \"kpc | table/columns/mass/data: 3 4 | "
          "table/columns/temperature/data: 5 6 | table/columns/temperature/mask: 0 1"},
         "unit position kpc | mass 3 4 | no temperature | note temperature"},
        {"DataFramesOfPandasAreRead",
         {"df/block0_items lines: x, y, z, mass | df/block0_values x4: 1 2 3 10 4 5 6 20"},
         "position 1 2 3 4 5 6 | mass 10 20"},
        {"PositionsInAPlaneHaveNoHeight",
         {"pos x2: 1 2 4 5 7 8 9 9"},
         "position 1 2 0 4 5 0 7 8 0 9 9 0 | note pos z is 0 for all"}}),
    name_of_row);

// Datasets that the call names.
const std::string named =
    "sim/a: 1 4 | sim/b: 2 5 | sim/c: 3 6 | sim/where x3: 1 2 3 4 5 6 | "
    "sim/table x4: 1 2 3 70 4 5 6 80 7 8 9 90 0 0 0 0 1 1 1 1 | sim/short: 1 | "
    "list of px, py, pz, m: 1 2 3 10 4 5 6 20 | stars/q x3: 1 2 3";

INSTANTIATE_TEST_SUITE_P(
    OfNamedColumns, DescribedHdf5,
    ::testing::ValuesIn(std::vector<SnapshotRow>{
        {"AreDatasetsByTheirPaths",
         {named},
         "position 1 2 3 4 5 6 | mass 1 4 | unit position kpc",
         {{"x [kpc]=sim/a", "y=/sim/b", "z = sim/c", "mass=sim/a"}}},
        {"AreMembersOfRecords",
         {named},
         "position 1 2 3 4 5 6 | mass 10 20",
         {{"x=list:px", "y=list:py", "z=list:pz", "mass=list:m"}}},
        {"AreColumnsOfATableByTheirNumbersFromOne",
         {named},
         "mass 70 80 90 0 1",
         {{"x=sim/table:1", "y=sim/table:2", "z=sim/table:3", "m=sim/table:4"}}},
        {"HaveNoNumberAboveThoseThatThereAre",
         {named},
         "misuse a number from 1 to 4",
         {{"x=sim/table:5"}}},
        {"HaveNoNumberZero", {named}, "misuse a number from 1 to 4", {{"x=sim/table:0"}}},
        {"MayBeVectorsOfATypeThatTheGroupNames",
         {named},
         "position/4 1 2 3",
         {{"position=stars/q"}}},
        {"ThatAreNotThereAreRefusedWithWhatIs",
         {named},
         "misuse no such dataset | misuse sim/table (5 x 4)",
         {{"x=sim/d"}}},
        {"OfMembersThatAreNotThereAreRefusedWithThoseThatAre",
         {named},
         "misuse one of px, py, pz, m | misuse did you mean px?",
         {{"x=list:pxx"}}},
        {"OfSeveralNumbersAreRefused", {named}, "misuse 4 numbers in each row", {{"x=sim/table"}}},
        {"OfRecordsAreRefused", {named}, "misuse \"list:px\"", {{"x=list"}}},
        {"OfOtherLengthsAreRefused",
         {named},
         "misuse x with 2 rows and z with 1",
         {{"x=sim/a", "y=sim/b", "z=sim/short"}}},
        {"WithoutTheirDatasetsAreRefused",
         {named},
         "misuse expected NAME=DATASET",
         {{"x", "y", "z"}}},
        {"MayBeThoseOfASnapshotWithAHeader",
         {"gadget 2 0 | Header@Time: 0.5 | PartType0/CenterOfMass x3: 7 8 9 1 2 3"},
         "position 7 8 9 1 2 3 | time 0.5",
         {{"position=PartType0/CenterOfMass"}}}}),
    name_of_row);

TEST(NamedColumns, AreLookedForInTheGroupOfThePath) {
  const TemporaryFolder folder;
  write_described_hdf5(folder / "any.h5", named);
  expect_snapshot(folder / "any.h5" / "sim", {{"position=where"}}, "position 1 2 3 4 5 6");
}

TEST_F(PlainHdf5, FloatsAreTakenAsTheyAre) {
  for (const bool has_vector : {true, false}) {
    {
      const Hdf5Output file = create_hdf5(path_);
      if (has_vector) {
        write_values(file, "pos", {1e-7, 0, 0, 1000, 0, 0}, 3, H5T_IEEE_F32LE);
      } else {
        write_values(file, "x", {1e-7, 1000}, 1, H5T_IEEE_F32LE);
        write_values(file, "y", {0, 0}, 1, H5T_IEEE_F32LE);
        write_values(file, "z", {0, 0}, 1, H5T_IEEE_F32LE);
      }
    }
    const auto snapshot = open_snapshot(path_);
    EXPECT_EQ(snapshot->read(0, "position")[0], 1e-7F);
    EXPECT_EQ(snapshot->position_origin().a[0], 0);
  }
}

// The same two particles at several times, as H5Part and others write them.
void write_steps(const std::filesystem::path& path, const std::vector<std::string>& groups) {
  const Hdf5Output file = create_hdf5(path);
  double number = 0;
  for (const std::string& group : groups) {
    const std::array<const char*, 3> axes = {"/x", "/y", "/z"};
    for (const char* axis : axes)
      write_values(file, group + axis, {number, number + 1});
    write_values(file, group + "/mass", {number, number});
    write_attribute(file, group, "time", {number / 4});
    ++number;
  }
}

TEST_F(PlainHdf5, StepsInTimeAreNotDrawnTogether) {
  for (const std::vector<std::string>& groups :
       {std::vector<std::string>{"Step#0", "Step#2", "Step#10"},
        {"0000", "0001", "0002"},
        {"state_8", "state_9", "state_10"},
        {"start", "middle", "end"}}) {
    write_steps(path_, groups);
    const auto last = open_snapshot(path_);
    ASSERT_EQ(last->info().types.size(), 1U);
    EXPECT_THAT(values_of(last->read(0, "mass")), ElementsAre(2, 2));
    EXPECT_EQ(last->info().time, 0.5);
    EXPECT_THAT(last->info().notes, Contains(HasSubstr("3 steps in time, /" + groups[0])));
    const auto second = open_snapshot(path_ / groups[1]);
    EXPECT_THAT(values_of(second->read(0, "mass")), ElementsAre(1, 1));
    EXPECT_EQ(second->info().time, 0.25);
    EXPECT_EQ(second->info().files, std::vector<std::filesystem::path>{path_});
  }
}

// What is kept beside the file for one step must not be taken for another.
TEST_F(PlainHdf5, PositionsTellTheStepThatTheyAreOf) {
  write_steps(path_, {"Step#0", "Step#1"});
  const auto file_name = [this](const char* step) {
    return require_field(open_snapshot(path_ / step)->info(), 0, "position").file_name;
  };
  EXPECT_EQ(file_name("Step#0"), "Step#0/x,Step#0/y,Step#0/z");
  EXPECT_EQ(file_name("Step#1"), "Step#1/x,Step#1/y,Step#1/z");
}

TEST_F(PlainHdf5, StepsMayBeRowsOfATable) {
  {
    const Hdf5Output file = create_hdf5(path_);
    write_values(file, "pos", {1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4}, 3);
    write_values(file, "step", {0, 0, 1, 1});
  }
  EXPECT_THAT(absolute_positions(*open_snapshot(path_), 0), ElementsAre(3, 3, 3, 4, 4, 4));
  EXPECT_THAT(absolute_positions(*open_snapshot(path_ / "step=0"), 0),
              ElementsAre(1, 1, 1, 2, 2, 2));
}

TEST_F(PlainHdf5, AStepThatIsNotThereIsRefusedWithThoseThatAre) {
  write_steps(path_, {"Step#0", "Step#1"});
  EXPECT_THAT(refusal(path_ / "Step#2"), AllOf(HasSubstr("group Step#2"), HasSubstr("/Step#1")));
  write_steps(path_, {"Step#1", "Step#2", "Step#9", "Step#10"});
  EXPECT_THAT(refusal(path_ / "Step#3"),
              HasSubstr("expected one of 4 steps in time, /Step#1 to /Step#10"));
  write_bytes(folder_ / "table", "x y z\n1 2 3\n4 5 6\n");
  EXPECT_THAT(refusal(folder_ / "table" / "Step#0"), HasSubstr("no steps in time in the table"));
}

// Positions in centimeters, the domain in yt's code_length, and the header of the simulation.
TEST_F(PlainHdf5, YtsDomainIsConvertedToTheUnitOfPositions) {
  for (const char* const unit : {"kpccm/h", "furlong"}) {
    {
      const Hdf5Output file = create_hdf5(path_);
      write_text(file, "/", "data_type", "yt_data_container");
      write_attribute(file, "/", "BoxSize", {50000});
      write_attribute(file, "/", "current_redshift", {1});
      write_attribute(file, "/", "hubble_constant", {0.5});
      write_attribute(file, "/", "length_unit", {2});
      write_text(file, "/", "length_unit_units", unit);
      write_attribute(file, "/", "domain_left_edge", {0, 0, 0});
      write_attribute(file, "/", "domain_right_edge", {100, 100, 100});
      write_text(file, "/", "domain_right_edge_units", "code_length");
      write_values(file, "gas/particle_position", {1, 2, 3}, 3);
      write_text(file, "gas/particle_position", "units", "cm");
    }
    const auto box = open_snapshot(path_)->info().box_size;
    if (std::string(unit) == "furlong") {
      EXPECT_FALSE(box);
    } else {
      ASSERT_TRUE(box);
      EXPECT_NEAR(box->longest() / (200 * 3.0856775815e21), 1, 1e-9);
    }
  }
}

// HDF5 lets nobody in a process change a file that another one of it has open.
TEST_F(PlainHdf5, IsNotOpenWhileNothingIsRead) {
  {
    const Hdf5Output file = create_hdf5(path_);
    write_values(file, "pos", {1, 2, 3, 4, 5, 6}, 3);
  }
  const auto snapshot = open_snapshot(path_);
  snapshot->read(0, "position");
  const Hdf5Handle<H5Fclose> other(H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT));
  EXPECT_TRUE(other.is_valid());
}

TEST_F(PlainHdf5, RowsThatWereNeverWrittenAreRefusedBeforeMemoryIsTaken) {
  {
    const Hdf5Output file = create_hdf5(path_);
    const hsize_t shape[2] = {hsize_t{1} << 50, 3}, chunk[2] = {1024, 3};
    const Hdf5Handle<H5Sclose> space(H5Screate_simple(2, shape, nullptr));
    const Hdf5Handle<H5Pclose> properties(H5Pcreate(H5P_DATASET_CREATE));
    H5Pset_chunk(properties.id(), 2, chunk);
    const Hdf5Handle<H5Dclose> dataset(H5Dcreate2(file.id(), "pos", H5T_IEEE_F64LE, space.id(),
                                                  H5P_DEFAULT, properties.id(), H5P_DEFAULT));
  }
  EXPECT_THAT([&] { open_snapshot(path_)->read(0, "position"); },
              ThrowsMessage<DataError>(HasSubstr("they are not all in the file")));
}

}  // namespace
}  // namespace splotchcl::test
