
#include "formats/halo_catalog.h"
#include "formats/hdf5/hdf5_file.h"
#include "formats/hdf5/hdf5_values.h"
#include "formats/snapshot_checks.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl {
namespace {

using ::testing::Optional;
using namespace splotchcl::test;

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

class HaloCatalog : public ::testing::Test {
 protected:
  // Haloes by rows, types by columns.
  void write_groups(const std::string& name, const std::vector<double>& lengths, double files = 1,
                    const std::vector<double>& offsets = {}) const {
    const Hdf5Output file = create_hdf5(folder_ / name);
    make_group(file, "Header");
    write_attribute(file, "Header", "NumFiles", {files});
    write_attribute(file, "Header", "Ngroups_Total", {4});
    if (!lengths.empty()) write_values(file, "Group/GroupLenType", lengths, 3, H5T_STD_I32LE);
    if (!offsets.empty()) write_values(file, "Group/GroupOffsetType", offsets, 3, H5T_STD_I64LE);
  }
  std::vector<std::uint64_t> places(const std::string& name, std::uint64_t number, int type) const {
    const HaloMembers members = read_halo(folder_ / name, number, type);
    EXPECT_FALSE(members.ids);
    std::vector<std::uint64_t> all;
    for (std::uint64_t place = 0; place < 100; ++place) {
      if (members.has_place(place)) all.push_back(place);
    }
    return all;
  }
  std::string refusal_of(const std::string& name, std::uint64_t number) const {
    try {
      read_halo(folder_ / name, number, 0);
    } catch (const DataError& error) {
      return error.what();
    }
    return {};
  }
  const TemporaryFolder folder_;
};

TEST_F(HaloCatalog, LengthsByTypeFollowEachOther) {
  write_groups("tab.hdf5", {3, 0, 1, 2, 5, 0});
  EXPECT_THAT(places("tab.hdf5", 0, 0), ElementsAre(0, 1, 2));
  EXPECT_THAT(places("tab.hdf5", 1, 0), ElementsAre(3, 4));
  EXPECT_THAT(places("tab.hdf5", 0, 1), IsEmpty());
  EXPECT_THAT(places("tab.hdf5", 1, 1), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(places("tab.hdf5", 1, 5), IsEmpty()) << "a type of which it says nothing";
}

TEST_F(HaloCatalog, OffsetsInTheFileAreUsed) {
  write_groups("tab.hdf5", {3, 0, 1, 2, 5, 0}, 1, {0, 0, 0, 10, 7, 1});
  EXPECT_THAT(places("tab.hdf5", 1, 0), ElementsAre(10, 11));
}

TEST_F(HaloCatalog, InSeveralFilesIsReadFromAnyOfThem) {
  write_groups("tab.0.hdf5", {3, 0, 1, 2, 5, 0}, 3);
  write_groups("tab.1.hdf5", {}, 3);
  write_groups("tab.2.hdf5", {4, 0, 0, 1, 0, 0}, 3);
  for (const char* name : {"tab.0.hdf5", "tab.2.hdf5"}) {
    EXPECT_THAT(places(name, 1, 0), ElementsAre(3, 4));
    EXPECT_THAT(places(name, 3, 0), ElementsAre(9));
  }
}

TEST_F(HaloCatalog, AHaloThatIsNotThereIsRefusedWithWhatThereIs) {
  write_groups("tab.hdf5", {3, 0, 1, 2, 5, 0});
  EXPECT_THAT(refusal_of("tab.hdf5", 2), HasSubstr("no halo 2, expected a number from 0 to 1"));
  write_groups("none.hdf5", {});
  EXPECT_THAT(refusal_of("none.hdf5", 0), HasSubstr("the catalog has no haloes"));
}

TEST_F(HaloCatalog, SoapsMembershipsAreFoundInTheOrderOfTheSnapshot) {
  for (const bool says_how_many : {true, false}) {
    for (const char* const name : {"membership.0.hdf5", "membership.1.hdf5"}) {
      const Hdf5Output file = create_hdf5(folder_ / name);
      make_group(file, "Header");
      if (says_how_many) write_attribute(file, "Header", "NumFilesPerSnapshot", {2});
      write_values(file, "PartType1/GroupNr_bound", {-1, 7, 7, 3, 7}, 1, H5T_STD_I32LE);
    }
    EXPECT_THAT(places("membership.0.hdf5", 7, 1), ElementsAre(1, 2, 4, 6, 7, 9));
    EXPECT_THAT(places("membership.0.hdf5", 7, 0), IsEmpty());
  }
}

TEST_F(HaloCatalog, VelociraptorsHaloesHaveBoundAndUnboundParticlesByIdentifier) {
  {
    const Hdf5Output groups = create_hdf5(folder_ / "stf.catalog_groups");
    write_values(groups, "Group_Size", {3, 2}, 1, H5T_STD_U32LE);
    write_values(groups, "Offset", {0, 2}, 1, H5T_STD_U64LE);
    write_values(groups, "Offset_unbound", {0, 1}, 1, H5T_STD_U64LE);
    const Hdf5Output bound = create_hdf5(folder_ / "stf.catalog_particles");
    write_values(bound, "Particle_IDs", {50, 40, 10}, 1, H5T_STD_I64LE);
    const Hdf5Output unbound = create_hdf5(folder_ / "stf.catalog_particles.unbound");
    write_values(unbound, "Particle_IDs", {60, 5}, 1, H5T_STD_I64LE);
  }
  EXPECT_THAT(read_halo(folder_ / "stf.catalog_groups", 1, 0).ids,
              Optional(ElementsAre(40, 50, 60)));
  EXPECT_THAT(read_halo(folder_ / "stf.catalog_groups", 2, 0).ids, Optional(ElementsAre(5, 10)));
  EXPECT_THAT(refusal_of("stf.catalog_groups", 0), HasSubstr("expected a number from 1 to 2"));
  std::filesystem::remove(folder_ / "stf.catalog_particles");
  EXPECT_THAT(refusal_of("stf.catalog_groups", 1), HasSubstr("are not beside it"));
}

TEST_F(HaloCatalog, OtherFilesAreRefused) {
  write_bytes(folder_ / "halos.txt", "1 2 3\n");
  EXPECT_THAT(refusal_of("halos.txt", 0), HasSubstr("no halo 0 in a list that Rockstar"));
  write_values(create_hdf5(folder_ / "other.hdf5"), "Coordinates", {1, 2, 3}, 3);
  EXPECT_THAT(refusal_of("other.hdf5", 0), HasSubstr("found no Group/GroupLenType"));
}

TEST_F(HaloCatalog, IsFoundBesideASnapshotByItsName) {
  EXPECT_FALSE(find_halo_catalog(folder_ / "snap_099.hdf5"));
  write_groups("fof_subhalo_tab_099.hdf5", {1, 0, 0});
  EXPECT_EQ(find_halo_catalog(folder_ / "snap_099.hdf5"), folder_ / "fof_subhalo_tab_099.hdf5");
  EXPECT_EQ(find_halo_catalog(folder_ / "snapshot_099.3.hdf5"),
            folder_ / "fof_subhalo_tab_099.hdf5");
  EXPECT_FALSE(find_halo_catalog(folder_ / "snap_098.hdf5"));
  EXPECT_FALSE(find_halo_catalog(folder_ / "snap"));
}

}  // namespace
}  // namespace splotchcl
