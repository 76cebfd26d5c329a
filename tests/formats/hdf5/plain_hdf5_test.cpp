#include "formats/hdf5/hdf5_values.h"
#include "formats/snapshot_checks.h"
#include "snapshot/field_names.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

class PlainHdf5 : public ::testing::Test {
 protected:
  std::vector<double> positions(const Snapshot& snapshot, int type) const {
    const Column offsets = snapshot.read(type, "position");
    std::vector<double> values;
    for (std::size_t i = 0; i < offsets.size(); ++i) {
      values.push_back(static_cast<double>(offsets[i]) + snapshot.position_origin().a[i % 3]);
    }
    return values;
  }
  const TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "particles.h5";
};

TEST_F(PlainHdf5, DatasetsAtTheRootAreRead) {
  {
    const Hdf5Output file = create_hdf5(path_);
    write_values(file, "pos", {1, 2, 3, 4, 5, 6}, 3);
    write_values(file, "mass", {7, 8});
    write_values(file, "ids", {4294967297.0, 2}, 1, H5T_STD_U64LE);
    write_values(file, "halo_masses", {1, 2, 3});
    write_attribute(file, "/", "BoxSize", {64});
    write_attribute(file, "/", "time", {0.5});
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_EQ(snapshot->info().format, "HDF5 without a header");
  EXPECT_EQ(snapshot->info().find_type(0)->count, 2U);
  EXPECT_EQ(snapshot->info().box_size, 64);
  EXPECT_EQ(snapshot->info().time, 0.5);
  EXPECT_THAT(positions(*snapshot, 0), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(values_of(snapshot->read(0, "mass")), ElementsAre(7, 8));
  EXPECT_THAT(snapshot->read_ids(0), ElementsAre(4294967297U, 2U));
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("halo_masses")));
}

TEST_F(PlainHdf5, AxesOfTheirOwnAreJoined) {
  {
    const Hdf5Output file = create_hdf5(path_);
    for (const auto& [name, values] : std::vector<std::pair<std::string, std::vector<double>>>{
             {"x", {1, 4}}, {"y", {2, 5}}, {"z", {3, 6}}, {"rho", {7, 8}}}) {
      write_values(file, name, values);
    }
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_THAT(positions(*snapshot, 0), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(values_of(snapshot->read(0, "density")), ElementsAre(7, 8));
}

TEST_F(PlainHdf5, SizesOfUnitsThatAttributesStateAreRead) {
  {
    const Hdf5Output file = create_hdf5(path_);
    write_values(file, "Coordinates", {1, 2, 3, 4, 5, 6}, 3);
    write_values(file, "Masses", {7, 8});
    write_attribute(file, "Coordinates", "CGSConversionFactor", {3.085678e24});
    write_attribute(file, "Masses", "to_cgs", {1.989e43});
    write_attribute(file, "Masses", "h_scaling", {-1});
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_EQ(find_field(snapshot->info().types.front(), "position")->unit, "Mpc");
  EXPECT_EQ(find_field(snapshot->info().types.front(), "mass")->unit, "1e10 M_sun h^-1");
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

TEST_F(PlainHdf5, TheOnlyRowsOfThreeArePositionsWhateverTheirName) {
  {
    const Hdf5Output file = create_hdf5(path_);
    write_values(file, "dataset", {1, 2, 3, 4, 5, 6}, 3);
    write_values(file, "velocities", {1, 2, 3, 4, 5, 6}, 3);
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_THAT(positions(*snapshot, 0), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(snapshot->info().notes, Contains("dataset /dataset is taken for the positions"));
}

TEST_F(PlainHdf5, GroupsAreTypesByTheirNames) {
  {
    const Hdf5Output file = create_hdf5(path_);
    write_values(file, "PartType0/Coordinates", {1, 2, 3, 4, 5, 6}, 3);
    write_values(file, "dark_matter/pos", {7, 8, 9}, 3);
    write_values(file, "star/pos", {1, 1, 1, 2, 2, 2, 3, 3, 3}, 3);
    write_values(file, "all/pos", {7, 8, 9}, 3);
    write_values(file, "profile/radius", {7, 8, 9});
  }
  const auto snapshot = open_snapshot(path_);
  ASSERT_EQ(snapshot->info().types.size(), 3U);
  EXPECT_EQ(snapshot->info().find_type(4)->count, 3U);
  EXPECT_THAT(positions(*snapshot, 0), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(positions(*snapshot, 1), ElementsAre(7, 8, 9));
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("group /all is left out")));
}

TEST_F(PlainHdf5, TypesInSeveralUnitsAreConverted) {
  {
    const Hdf5Output file = create_hdf5(path_);
    for (const auto& [group, length, mass] :
         std::vector<std::array<std::string, 3>>{{"gas", "kpc", "kg"}, {"stars", "pc", "g"}}) {
      write_values(file, group + "/pos", {1000, 2000, 3000}, 3);
      write_text(file, group + "/pos", "units", length);
      write_values(file, group + "/mass", {500});
      write_text(file, group + "/mass", "units", mass);
    }
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_THAT(positions(*snapshot, 0), ElementsAre(1000, 2000, 3000));
  EXPECT_THAT(positions(*snapshot, 4), ElementsAre(1, 2, 3));
  EXPECT_THAT(values_of(snapshot->read(0, "mass")), ElementsAre(500));
  EXPECT_THAT(values_of(snapshot->read(4, "mass")), ElementsAre(0.5F));
  EXPECT_THAT(snapshot->info().notes, Contains("mass of type 4 is converted from g to kg"));
}

TEST_F(PlainHdf5, GroupsOfOtherNamesAreTypesInTheirOrder) {
  {
    const Hdf5Output file = create_hdf5(path_);
    write_values(file, "first/pos", {1, 2, 3}, 3);
    write_values(file, "second/pos", {7, 8, 9}, 3);
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_THAT(positions(*snapshot, 1), ElementsAre(7, 8, 9));
  EXPECT_THAT(snapshot->info().notes, Contains("the particles of /second are taken for type 1"));
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
  EXPECT_THAT(positions(*open_snapshot(path_), 0), ElementsAre(3, 3, 3, 4, 4, 4));
  EXPECT_THAT(positions(*open_snapshot(path_ / "step=0"), 0), ElementsAre(1, 1, 1, 2, 2, 2));
}

TEST_F(PlainHdf5, PackedNumbersAreUnpackedAndComplexOnesSaid) {
  {
    const Hdf5Output file = create_hdf5(path_);
    write_values(file, "pos", {1, 2, 3, 4, 5, 6}, 3);
    write_values(file, "mass", {100, 250}, 1, H5T_STD_I16LE);
    write_attribute(file, "mass", "scale_factor", {0.01});
    write_attribute(file, "mass", "add_offset", {2});
    const Hdf5Handle<H5Tclose> complex(H5Tcreate(H5T_COMPOUND, 16));
    H5Tinsert(complex.id(), "r", 0, H5T_NATIVE_DOUBLE);
    H5Tinsert(complex.id(), "i", 8, H5T_NATIVE_DOUBLE);
    const hsize_t rows = 2;
    const Hdf5Handle<H5Sclose> space(H5Screate_simple(1, &rows, nullptr));
    const Hdf5Handle<H5Dclose> dataset(H5Dcreate2(file.id(), "psi", complex.id(), space.id(),
                                                  H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_THAT(values_of(snapshot->read(0, "mass")), ElementsAre(3, 4.5F));
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("2 particles: psi")));
}

TEST_F(PlainHdf5, RecordsAndRowsOfOtherShapesAreRefusedForWhatTheyAre) {
  {
    const Hdf5Output file = create_hdf5(path_);
    write_values(file, "pos", std::vector<double>(20), 5);
    const Hdf5Handle<H5Tclose> record(H5Tcreate(H5T_COMPOUND, 8));
    H5Tinsert(record.id(), "x", 0, H5T_NATIVE_DOUBLE);
    const hsize_t rows = 4;
    const Hdf5Handle<H5Sclose> space(H5Screate_simple(1, &rows, nullptr));
    const Hdf5Handle<H5Dclose> dataset(H5Dcreate2(file.id(), "particles", record.id(), space.id(),
                                                  H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  }
  EXPECT_THAT(refusal(path_), AllOf(HasSubstr("particles (4 records), pos (4 x 5)"),
                                    HasSubstr("read.columns = {x = ")));
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

TEST_F(PlainHdf5, NumbersOfOtherGroupsAreNoSteps) {
  {
    const Hdf5Output file = create_hdf5(path_);
    write_values(file, "cloud_1/pos", {1, 2, 3}, 3);
    write_values(file, "cloud_2/pos", {4, 5, 6}, 3);
  }
  EXPECT_EQ(open_snapshot(path_)->info().types.size(), 2U);
}

TEST_F(PlainHdf5, YtsNamesUnitsAndDomainAreUnderstood) {
  {
    const Hdf5Output file = create_hdf5(path_);
    write_text(file, "/", "data_type", "yt_data_container");
    write_attribute(file, "/", "current_redshift", {2});
    write_attribute(file, "/", "domain_left_edge", {0, 0, 0});
    write_attribute(file, "/", "domain_right_edge", {64, 64, 64});
    write_text(file, "/", "domain_right_edge_units", "cm");
    for (const char* axis : {"x", "y", "z"}) {
      const std::string name = std::string("PartType4/particle_position_") + axis;
      write_values(file, name, {1, 2});
      write_text(file, name, "units", "cm");
    }
    write_values(file, "PartType4/particle_mass", {5, 6});
    write_values(file, "PartType4/particle_index", {9007199254740991.0, 10});
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_EQ(snapshot->info().format, "HDF5 by yt's save_as_dataset");
  EXPECT_EQ(snapshot->info().redshift, 2);
  EXPECT_EQ(snapshot->info().box_size, 64);
  EXPECT_THAT(positions(*snapshot, 4), ElementsAre(1, 1, 1, 2, 2, 2));
  EXPECT_THAT(values_of(snapshot->read(4, "mass")), ElementsAre(5, 6));
  EXPECT_THAT(snapshot->read_ids(4), ElementsAre(9007199254740991U, 10U));
  EXPECT_EQ(snapshot->info().types[0].fields[0].unit, "cm");
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

TEST_F(PlainHdf5, IdentifiersThatAreNotWholeAreRefused) {
  {
    const Hdf5Output file = create_hdf5(path_);
    write_values(file, "pos", {1, 2, 3, 4, 5, 6}, 3);
    write_values(file, "ids", {1, 2.5});
  }
  EXPECT_THAT([&] { open_snapshot(path_)->read_ids(0); },
              ThrowsMessage<DataError>(HasSubstr("not one whole number")));
}

TEST_F(PlainHdf5, IdentifiersMayBeWholeFloats) {
  {
    const Hdf5Output file = create_hdf5(path_);
    write_values(file, "pos", {1, 2, 3, 4, 5, 6}, 3);
    write_values(file, "ids", {9007199254740991.0, 2});
  }
  EXPECT_THAT(open_snapshot(path_)->read_ids(0), ElementsAre(9007199254740991U, 2U));
}

TEST_F(PlainHdf5, ASingleMassIsThatOfAllParticles) {
  {
    const Hdf5Output file = create_hdf5(path_);
    write_values(file, "pos", {1, 2, 3, 4, 5, 6}, 3);
    const Hdf5Handle<H5Sclose> space(H5Screate(H5S_SCALAR));
    const Hdf5Handle<H5Dclose> mass(H5Dcreate2(file.id(), "mass", H5T_IEEE_F64LE, space.id(),
                                               H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    const double value = 2.5;
    H5Dwrite(mass.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value);
  }
  EXPECT_THAT(values_of(open_snapshot(path_)->read(0, "mass")), ElementsAre(2.5F, 2.5F));
}

TEST_F(PlainHdf5, AnAxisOfAnotherLengthIsNotTakenForZero) {
  {
    const Hdf5Output file = create_hdf5(path_);
    write_values(file, "x", {1, 4});
    write_values(file, "y", {2, 5});
    write_values(file, "z", {3, 6, 9});
  }
  EXPECT_THAT([&] { open_snapshot(path_); },
              ThrowsMessage<DataError>(HasSubstr("z has not the 2 rows")));
}

TEST_F(PlainHdf5, WhatOtherGroupsHaveOfAsManyParticlesIsSaid) {
  {
    const Hdf5Output file = create_hdf5(path_);
    write_values(file, "where/pos", {1, 2, 3, 4, 5, 6}, 3);
    write_values(file, "what/mass", {7, 8});
    write_values(file, "what/other", {7, 8, 9});
  }
  EXPECT_THAT(open_snapshot(path_)->info().notes,
              Contains(HasSubstr("left out of /what, which has no positions: mass;")));
}

TEST_F(PlainHdf5, ATypeWithoutRowsIsLeftOut) {
  {
    const Hdf5Output file = create_hdf5(path_);
    write_values(file, "gas/pos", {1, 2, 3, 4, 5, 6}, 3);
    write_values(file, "stars/pos", {}, 3);
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_EQ(snapshot->info().types.size(), 1U);
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("/stars is left out")));
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

TEST_F(PlainHdf5, AHeaderThatCountsNothingIsNoObstacle) {
  {
    const Hdf5Output file = create_hdf5(path_);
    make_group(file, "Header");
    write_attribute(file, "Header", "Redshift", {3});
    write_values(file, "PartType1/Coordinates", {1, 2, 3, 4, 5, 6}, 3);
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_EQ(snapshot->info().redshift, 3);
  EXPECT_EQ(snapshot->info().find_type(1)->count, 2U);
}

TEST_F(PlainHdf5, WithoutPositionsIsRefusedWithWhatIsExpected) {
  {
    const Hdf5Output file = create_hdf5(path_);
    write_values(file, "mass", {1, 2, 3});
  }
  EXPECT_THAT(refusal(path_),
              HasSubstr("no positions whose names tell what they are (it holds: mass (3))"));
}

TEST_F(PlainHdf5, PositionsWithoutRowsAreRefused) {
  {
    const Hdf5Output file = create_hdf5(path_);
    write_values(file, "pos", {}, 3);
  }
  EXPECT_THAT(refusal(path_), HasSubstr("have no rows"));
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
