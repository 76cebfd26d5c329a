#include "formats/halo_catalog.h"

#include "formats/hdf5/hdf5_values.h"
#include "formats/snapshot_checks.h"
#include "temporary_folder.h"

namespace splotchcl {
namespace {

using namespace splotchcl::test;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Optional;

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
  for (int part = 0; part < 2; ++part) {
    const Hdf5Output file = create_hdf5(folder_ / ("membership." + std::to_string(part) + ".hdf5"));
    make_group(file, "Header");
    write_attribute(file, "Header", "NumFilesPerSnapshot", {2});
    write_values(file, "PartType1/GroupNr_bound", {-1, 7, 7, 3, 7}, 1, H5T_STD_I32LE);
  }
  EXPECT_THAT(places("membership.0.hdf5", 7, 1), ElementsAre(1, 2, 4, 6, 7, 9));
  EXPECT_THAT(places("membership.0.hdf5", 7, 0), IsEmpty());
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
  EXPECT_THAT(refusal_of("halos.txt", 0), HasSubstr("not an HDF5 file"));
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
