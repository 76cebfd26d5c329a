#include "formats/hdf5/hdf5_values.h"
#include "formats/snapshot_checks.h"
#include "splotchcl/snapshot_file.h"
#include "temporary_folder.h"

namespace splotchcl {
namespace {

using namespace splotchcl::test;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(ParticlesGroup, WithoutAHeaderIsRead) {
  const TemporaryFolder folder;
  {
    const Hdf5Output file = create_hdf5(folder / "dump.h5");
    write_values(file, "particles/xyz", {1, 2, 3, 4, 5, 6}, 3);
    write_values(file, "particles/h", {0.5, 1});
    write_values(file, "particles/m", {7, 8});
    write_values(file, "particles/rho", {9, 10});
  }
  const auto snapshot = open_snapshot(folder / "dump.h5");
  EXPECT_EQ(snapshot->info().format, "HDF5 with a group particles, after sphNG");
  EXPECT_THAT(values_of(snapshot->read(0, "mass")), ElementsAre(7, 8));
  EXPECT_THAT(values_of(snapshot->read(0, "density")), ElementsAre(9, 10));
  EXPECT_THAT(values_of(snapshot->read(0, "smoothing_length")), ElementsAre(1, 2));
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("as in sphNG it is taken to reach 2 h")));
}

TEST(ParticlesGroup, AxesOfTheirOwnAreJoined) {
  const TemporaryFolder folder;
  {
    const Hdf5Output file = create_hdf5(folder / "dump.h5");
    write_values(file, "particles/x", {1, 4, 1e6});
    write_values(file, "particles/y", {2, 5, 1e6});
    write_values(file, "particles/z", {3, 6, 1e6});
    write_values(file, "particles/vx", {1, 2, 3});
    write_values(file, "particles/vy", {4, 5, 6});
    write_values(file, "particles/vz", {7, 8, 9});
  }
  const auto snapshot = open_snapshot(folder / "dump.h5");
  EXPECT_EQ(snapshot->position_origin().a[0], 4);
  EXPECT_THAT(values_of(snapshot->read(0, "position")),
              ElementsAre(-3, -3, -3, 0, 0, 0, 999996, 999995, 999994));
  EXPECT_THAT(values_of(snapshot->read(0, "velocity")), ElementsAre(1, 4, 7, 2, 5, 8, 3, 6, 9));
  EXPECT_FALSE(has_field(*snapshot, 0, "mass"));
}

TEST(ParticlesGroup, FloatsOfAxesOfTheirOwnAreTakenAsTheyAre) {
  const TemporaryFolder folder;
  {
    const Hdf5Output file = create_hdf5(folder / "dump.h5");
    write_values(file, "particles/x", {1e-7, 1000}, 1, H5T_IEEE_F32LE);
    write_values(file, "particles/y", {0, 0}, 1, H5T_IEEE_F32LE);
    write_values(file, "particles/z", {0, 0}, 1, H5T_IEEE_F32LE);
  }
  EXPECT_EQ(open_snapshot(folder / "dump.h5")->read(0, "position")[0], 1e-7F);
}

TEST(ParticlesGroup, PhasesTellTheTypes) {
  const TemporaryFolder folder;
  {
    const Hdf5Output file = create_hdf5(folder / "dump.h5");
    write_values(file, "particles/xyz", {1, 1, 1, 2, 2, 2, 3, 3, 3}, 3);
    write_values(file, "particles/iphase", {0, -1, 3}, 1, H5T_STD_I8LE);
  }
  const auto snapshot = open_snapshot(folder / "dump.h5");
  EXPECT_THAT(values_of(snapshot->read(0, "iphase")), ElementsAre(0));
  EXPECT_THAT(values_of(snapshot->read(4, "iphase")), ElementsAre(3));
  EXPECT_THAT(values_of(snapshot->read(5, "iphase")), ElementsAre(-1));
}

TEST(ParticlesGroup, AxesOfDifferentLengthAreRefused) {
  const TemporaryFolder folder;
  {
    const Hdf5Output file = create_hdf5(folder / "dump.h5");
    write_values(file, "particles/x", {1, 4});
    write_values(file, "particles/y", {2, 5, 7});
    write_values(file, "particles/z", {3, 6});
  }
  EXPECT_THAT(refusal(folder / "dump.h5"), HasSubstr("y has 3 rows, but there are 2 positions"));
}

TEST(ParticlesGroup, RowsThatWereNeverWrittenAreRefusedBeforeMemoryIsTaken) {
  const TemporaryFolder folder;
  {
    const Hdf5Output file = create_hdf5(folder / "dump.h5");
    make_group(file, "particles");
    const hsize_t shape[2] = {hsize_t{1} << 50, 3}, chunk[2] = {1024, 3};
    const Hdf5Handle<H5Sclose> space(H5Screate_simple(2, shape, nullptr));
    const Hdf5Handle<H5Pclose> properties(H5Pcreate(H5P_DATASET_CREATE));
    H5Pset_chunk(properties.id(), 2, chunk);
    const Hdf5Handle<H5Dclose> dataset(H5Dcreate2(file.id(), "particles/xyz", H5T_IEEE_F64LE,
                                                  space.id(), H5P_DEFAULT, properties.id(),
                                                  H5P_DEFAULT));
  }
  EXPECT_THAT(refusal(folder / "dump.h5"), HasSubstr("they are not all in the file"));
}

TEST(ParticlesGroup, WithoutPositionsIsRefused) {
  const TemporaryFolder folder;
  {
    const Hdf5Output file = create_hdf5(folder / "dump.h5");
    write_values(file, "particles/x", {1, 4});
    write_values(file, "particles/h", {1, 4});
  }
  EXPECT_THAT(refusal(folder / "dump.h5"), HasSubstr("no positions"));
}

}  // namespace
}  // namespace splotchcl
