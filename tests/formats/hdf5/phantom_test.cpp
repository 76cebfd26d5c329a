#include <cmath>

#include "formats/hdf5/hdf5_file.h"
#include "formats/snapshot_checks.h"
#include "paths.h"
#include "splotchcl/snapshot_file.h"
#include "temporary_folder.h"

namespace splotchcl {
namespace {

using namespace splotchcl::test;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

void write_dataset(hid_t file, const std::string& path, const std::vector<double>& values,
                   hsize_t width = 1) {
  const hsize_t shape[2] = {values.size() / width, width};
  const Hdf5Handle<H5Sclose> space(H5Screate_simple(width > 1 ? 2 : 1, shape, nullptr));
  const Hdf5Handle<H5Pclose> links(H5Pcreate(H5P_LINK_CREATE));
  H5Pset_create_intermediate_group(links.id(), 1);
  const Hdf5Handle<H5Dclose> dataset(H5Dcreate2(file, path.c_str(), H5T_IEEE_F64LE, space.id(),
                                                links.id(), H5P_DEFAULT, H5P_DEFAULT));
  H5Dwrite(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
}

// Gas, dust, gas.
void write_phantom(const std::filesystem::path& path, bool has_positions = true,
                   const std::vector<double>& h = {1, 2, 4},
                   const std::vector<double>& itypes = {1, 7, 1}, hsize_t itype_width = 1) {
  const Hdf5Handle<H5Fclose> file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  write_dataset(file.id(), "header/massoftype", {0.5, 0, 0, 0, 0, 0, 0.125});
  write_dataset(file.id(), "header/hfact", {1.2});
  write_dataset(file.id(), "header/time", {7});
  if (has_positions) write_dataset(file.id(), "particles/xyz", {1, 2, 3, 4, 5, 6, 7, 8, 9}, 3);
  write_dataset(file.id(), "particles/h", h);
  write_dataset(file.id(), "particles/itype", itypes, itype_width);
  write_dataset(file.id(), "particles/dustfrac", {1, 2, 3, 4, 5, 6}, 2);
  write_dataset(file.id(), "sinks/xyz", {0, 0, 0}, 3);
}

TEST(Phantom, TypesAreToldApart) {
  const TemporaryFolder folder;
  write_phantom(folder / "dump.h5");
  const auto snapshot = open_snapshot(folder / "dump.h5");
  EXPECT_EQ(snapshot->info().format, "Phantom HDF5");
  EXPECT_EQ(snapshot->info().time, 7);
  ASSERT_EQ(snapshot->info().types.size(), 2U);
  EXPECT_EQ(snapshot->info().find_type(0)->count, 2U);
  EXPECT_EQ(snapshot->info().find_type(2)->count, 1U);
  EXPECT_EQ(snapshot->read(0, "mass").uniform_value(), 0.5F);
  EXPECT_EQ(snapshot->read(2, "mass").uniform_value(), 0.125F);
  const Vec3 origin = snapshot->position_origin();
  EXPECT_EQ(origin.a[0], 4);
  EXPECT_THAT(values_of(snapshot->read(0, "position")), ElementsAre(-3, -3, -3, 3, 3, 3));
  EXPECT_THAT(values_of(snapshot->read(2, "position")), ElementsAre(0, 0, 0));
}

TEST(Phantom, SmoothingLengthsReachTheEndOfTheKernel) {
  const TemporaryFolder folder;
  write_phantom(folder / "dump.h5");
  const auto snapshot = open_snapshot(folder / "dump.h5");
  EXPECT_THAT(values_of(snapshot->read(0, "smoothing_length")), ElementsAre(2, 8));
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("reach 2 h")));
}

TEST(Phantom, DensitiesFollowFromSmoothingLengths) {
  const TemporaryFolder folder;
  write_phantom(folder / "dump.h5");
  const Column density = open_snapshot(folder / "dump.h5")->read(0, "density");
  EXPECT_FLOAT_EQ(density[0], static_cast<float>(0.5 * std::pow(1.2, 3)));
  EXPECT_FLOAT_EQ(density[1], static_cast<float>(0.5 * std::pow(1.2 / 4, 3)));
}

TEST(Phantom, WhatIsLeftOutIsNoted) {
  const TemporaryFolder folder;
  write_phantom(folder / "dump.h5");
  const auto snapshot = open_snapshot(folder / "dump.h5");
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("dustfrac")));
  EXPECT_THAT(snapshot->info().notes,
              Contains(HasSubstr("sinks left out, as they have no smoothing length: 1")));
}

TEST(Phantom, WithoutPositionsIsRefused) {
  const TemporaryFolder folder;
  write_phantom(folder / "dump.h5", false);
  EXPECT_THAT(refusal(folder / "dump.h5"), HasSubstr("no positions"));
}

TEST(Phantom, DatasetsOfOtherLengthsAreRefused) {
  const TemporaryFolder folder;
  write_phantom(folder / "dump.h5", true, {1, 2});
  EXPECT_THAT(refusal(folder / "dump.h5"), HasSubstr("h has 2 rows, but there are 3 positions"));
}

TEST(Phantom, ADensityOfTheFilesOwnGoesBeforeThatFromSmoothingLengths) {
  const TemporaryFolder folder;
  write_phantom(folder / "dump.h5");
  {
    const Hdf5Handle<H5Fclose> file(
        H5Fopen((folder / "dump.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT));
    write_dataset(file.id(), "particles/rho", {10, 20, 30});
  }
  const Column density = open_snapshot(folder / "dump.h5")->read(0, "density");
  EXPECT_THAT(values_of(density), ElementsAre(10, 30));
}

TEST(Phantom, ParticlesOfNoKnownTypeAreKeptAndNoted) {
  const TemporaryFolder folder;
  const double nan = std::nan("");
  write_phantom(folder / "dump.h5", true, {1, 2, 4}, {-1, 0, nan});
  const auto snapshot = open_snapshot(folder / "dump.h5");
  EXPECT_EQ(snapshot->info().find_type(0)->count, 1U);
  EXPECT_EQ(snapshot->info().find_type(2)->count, 2U);
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("2 particles are of types without")));
}

TEST(Phantom, TypesThatAreNotOneNumberPerParticleAreRefused) {
  const TemporaryFolder folder;
  write_phantom(folder / "dump.h5", true, {1, 2, 4}, {1, 1}, 2);
  EXPECT_THAT(refusal(folder / "dump.h5"), HasSubstr("itype is not one number"));
}

TEST(RealPhantom, ADumpIsRead) {
  const std::filesystem::path data = test::data_folder();
  if (!std::filesystem::is_directory(data)) GTEST_SKIP() << "no real snapshots in " << data;
  const auto snapshot = open_snapshot(data / "phantom/dustmixture_00000.h5");
  EXPECT_EQ(snapshot->info().find_type(0)->count, 1000U);
  EXPECT_EQ(snapshot->read(0, "mass").uniform_value(), 5.05e-05F);
  EXPECT_EQ(snapshot->read(0, "position").size(), 3000U);
}

}  // namespace
}  // namespace splotchcl
