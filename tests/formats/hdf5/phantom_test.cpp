
#include "formats/halo_catalog.h"
#include "formats/hdf5/described_hdf5.h"
#include "formats/hdf5/hdf5_file.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl {
namespace {

using ::testing::Optional;
using namespace splotchcl::test;

INSTANTIATE_TEST_SUITE_P(Phantom, DescribedHdf5,
                         ::testing::ValuesIn(snapshot_rows("hdf5/phantom.rows")), name_of_row);

// From the middle of all, or, of floats, from 0.
TEST(PhantomOrigin, IsWherePositionsCountFrom) {
  const TemporaryFolder folder;
  write_described_hdf5(folder / "dump.h5",
                       "particles/xyz x3: 1 2 3 4 5 6 7 8 9 | particles/h: 1 2 4");
  const auto snapshot = open_snapshot(folder / "dump.h5");
  EXPECT_EQ(snapshot->position_origin().a[0], 4);
  EXPECT_THAT(values_of(snapshot->read(0, "position")), ElementsAre(-3, -3, -3, 0, 0, 0, 3, 3, 3));
  write_described_hdf5(folder / "dump.h5",
                       "particles/x f32: 1e-7 1000 | particles/y f32: 0 0 | particles/z f32: 0 0");
  EXPECT_EQ(open_snapshot(folder / "dump.h5")->read(0, "position")[0], 1e-7F);
}

TEST(RealPhantom, ADumpIsRead) {
  const std::filesystem::path data = test::data_folder();
  if (!std::filesystem::is_directory(data)) GTEST_SKIP() << "no real snapshots in " << data;
  const auto snapshot = open_snapshot(data / "phantom/dustmixture_00000.h5");
  EXPECT_EQ(snapshot->info().find_type(0)->count, 1000U);
  EXPECT_EQ(snapshot->read(0, "mass").uniform_value(), 5.05e-05F);
  EXPECT_EQ(snapshot->read(0, "position").size(), 3000U);
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
    return refusal_by<DataError>([&] { read_halo(folder_ / name, number, 0); });
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

TEST_F(HaloCatalog, LengthsBelowZeroAreRefusedWhicheverHaloIsWanted) {
  write_groups("tab.hdf5", {3, 0, 0, -2, 0, 0, 4, 0, 0});
  for (const std::uint64_t halo : {1U, 2U})
    EXPECT_THAT(refusal_of("tab.hdf5", halo), HasSubstr("GroupLenType holds -2 for halo 1"));
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
