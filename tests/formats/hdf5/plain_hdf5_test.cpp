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

INSTANTIATE_TEST_SUITE_P(Plain, DescribedHdf5,
                         ::testing::ValuesIn(snapshot_rows("hdf5/plain.rows")), name_of_row);

TEST_F(PlainHdf5, ColumnsAreLookedForInTheGroupOfThePath) {
  write_described_hdf5(path_, "sim/where x3: 1 2 3 4 5 6 | stars/q x3: 1 2 3");
  expect_snapshot(path_ / "sim", {{"position=where"}}, "position 1 2 3 4 5 6");
}

TEST_F(PlainHdf5, FloatsAreTakenAsTheyAre) {
  for (const char* const positions :
       {"pos x3 f32: 1e-7 0 0 1000 0 0", "x f32: 1e-7 1000 | y f32: 0 0 | z f32: 0 0"}) {
    write_described_hdf5(path_, positions);
    EXPECT_EQ(open_snapshot(path_)->read(0, "position")[0], 1e-7F);
    expect_snapshot(path_, {}, "origin 0");
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
  write_described_hdf5(path_, "pos x3: 1 1 1 2 2 2 3 3 3 4 4 4 | step: 0 0 1 1");
  expect_snapshot(path_, {}, "position 3 3 3 4 4 4");
  expect_snapshot(path_ / "step=0", {}, "position 1 1 1 2 2 2");
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
    write_described_hdf5(
        path_, std::string("/@length_unit_units: \"") + unit +
                   " | /@data_type: \"yt_data_container | /@BoxSize: 50000 | /@length_unit: 2 | "
                   "/@current_redshift: 1 | /@hubble_constant: 0.5 | /@domain_left_edge: 0 0 0 | "
                   "/@domain_right_edge: 100 100 100 | "
                   "/@domain_right_edge_units: \"code_length | "
                   "gas/particle_position x3: 1 2 3 | gas/particle_position@units: \"cm");
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
  write_described_hdf5(path_, "pos x3: 1 2 3 4 5 6");
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
