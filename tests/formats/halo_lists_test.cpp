// Catalogs of AHF, Rockstar and SOAP, and catalogs that are found beside snapshots.
#include "formats/halo_catalog.h"
#include "formats/hdf5/hdf5_values.h"
#include "formats/snapshot_checks.h"

namespace splotchcl::test {
namespace {

using ::testing::Optional;

class HaloLists : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const std::filesystem::path path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    write_bytes(path, text);
    return path;
  }
  static std::optional<std::vector<std::uint64_t>> ids_of(const std::filesystem::path& path,
                                                          std::uint64_t number) {
    return read_halo(path, number, 1).ids;
  }
  static std::string refusal_of_halo(const std::filesystem::path& path, std::uint64_t number) {
    return refusal_by<DataError>([&] { read_halo(path, number, 1); });
  }
  const TemporaryFolder folder_;
};

TEST_F(HaloLists, OfAhfHaveTheParticlesOfHaloesByTheirIdentifiers) {
  const auto path = write("s.AHF_particles",
                          "2\n3 7\n 18446744073709551615 1\n 11 1\n 13 4\n2 9\n 21 0\n 22 1\n");
  EXPECT_THAT(ids_of(path, 7), Optional(ElementsAre(11, 13, 18446744073709551615U)));
  EXPECT_THAT(ids_of(path, 9), Optional(ElementsAre(21, 22)));
  EXPECT_THAT(refusal_of_halo(path, 0), HasSubstr("no halo 0 among its 2"));
}

TEST_F(HaloLists, OfAhfWithoutIdentifiersCountFromZero) {
  const auto path = write("s.AHF_particles", "2\n3\n 11 1\n 12 1\n 13 4\n2\n 21 0\n 22 1\n");
  EXPECT_THAT(ids_of(path, 1), Optional(ElementsAre(21, 22)));
  const auto halos = write("s.AHF_halos", "#ID(1) hostHalo(2)\n5 0\n6 0\n");
  EXPECT_THAT(ids_of(halos, 6), Optional(ElementsAre(21, 22)));
}

TEST_F(HaloLists, OfAhfHaveLongIdentifiersOrCountFromZero) {
  const auto path =
      write("s.AHF_particles", "2\n1 33000000000001\n 11 1\n1 9223372036854775809\n 21 1\n");
  EXPECT_THAT(ids_of(path, 1), Optional(ElementsAre(21)));
  EXPECT_THAT(ids_of(path, 33000000000001), Optional(ElementsAre(11)));
  EXPECT_THAT(ids_of(path, 9223372036854775809U), Optional(ElementsAre(21)));
}

TEST_F(HaloLists, OfAhfThatAreCutOffAreRefused) {
  EXPECT_THAT(refusal_of_halo(write("a.AHF_particles", "1\n3\n 11 1\n"), 0),
              HasSubstr("truncated or damaged"));
  EXPECT_THAT(refusal_of_halo(write("b.AHF_particles", "2\n1\n 11 1\n"), 1),
              HasSubstr("the number of a halo's particles"));
  EXPECT_THAT(refusal_of_halo(write("c.AHF_particles", ""), 0), HasSubstr("the number of haloes"));
  EXPECT_THAT(refusal_of_halo(write("d.AHF_particles", "1\n99999999999999999999 3\n"), 0),
              HasSubstr("the number of a halo's particles"));
}

TEST_F(HaloLists, OfRockstarAreReadFromAllFilesOfACatalog) {
  const std::string names =
      "#Particle table begins here:\n#x y z vx vy vz particle_id assigned_internal_haloid "
      "internal_haloid external_haloid\n";
  const auto first =
      write("halos_33.0.particles",
            names + "1 2 3 0 0 0 50 1 1 4\n1 2 3 0 0 0 7 1 1 4\n1 2 3 0 0 0 9 1 1 -1\n");
  write("halos_33.1.particles", names + "1 2 3 0 0 0 30 1 1 4\n1 2 3 0 0 0 8 1 1 5\n");
  const auto list = write("halos_33.0.ascii", "#id num_p\n4 3\n");
  EXPECT_THAT(ids_of(first, 4), Optional(ElementsAre(7, 30, 50)));
  EXPECT_THAT(ids_of(list, 5), Optional(ElementsAre(8)));
  EXPECT_THAT(refusal_of_halo(first, 6), HasSubstr("no particles of halo 6"));
  EXPECT_THAT(refusal_of_halo(write("halos_1.0.particles", "1 2 3\n"), 4), HasSubstr("line 1"));
}

TEST_F(HaloLists, WithoutParticlesAreRefusedWithWhatHasThem) {
  EXPECT_THAT(refusal_of_halo(write("out_33.list", "#ID DescID\n1 -1\n"), 1),
              AllOf(HasSubstr("AHF_particles"), HasSubstr("no halo 1 in a list that Rockstar")));
}

TEST_F(HaloLists, OfRockstarWithoutParticlesSayWhereHaloesAre) {
  const auto list = write("out_33.list",
                          "#ID DescID Mvir Rvir X Y Z\n#Units: Positions in Mpc / h (comoving)\n"
                          "4 -1 1e12 250 10 20 30\n9223372036854775809 -1 1e12 125 1 2 3\n");
  const HaloMembers members = read_halo(list, 9223372036854775809U, 1);
  ASSERT_TRUE(members.sphere);
  EXPECT_THAT(members.sphere->center.a, ElementsAre(1, 2, 3));
  EXPECT_NEAR(members.sphere->radius, 0.125, 1e-12);
  EXPECT_EQ(members.sphere->unit, "Mpc/h a");
  EXPECT_THAT(refusal_of_halo(list, 5), HasSubstr("no halo 5"));
}

TEST_F(HaloLists, OfAhfWithoutParticlesSayWhereHaloesAreInKiloparsecs) {
  const auto list = write(
      "s.AHF_halos", "#ID(1) hostHalo(2) Xc(6) Yc(7) Zc(8) Rhalo(12)\n7 0 1000 2000 3000 500\n");
  const HaloMembers members = read_halo(list, 7, 1);
  ASSERT_TRUE(members.sphere);
  EXPECT_THAT(members.sphere->center.a, ElementsAre(1, 2, 3));
  EXPECT_NEAR(members.sphere->radius, 0.5, 1e-12);
}

TEST_F(HaloLists, OfRockstarThatAreCutOffAreRefused) {
  EXPECT_THAT(refusal_of_halo(write("out_1.list", "#ID Rvir X Y Z\n4 250 10\n"), 4),
              HasSubstr("line 2"));
}

TEST_F(HaloLists, OfSubfindCountSubhaloesToo) {
  const auto path = folder_ / "fof_subhalo_tab_1.hdf5";
  {
    const Hdf5Output file = create_hdf5(path);
    make_group(file, "Header");
    write_values(file, "Group/GroupLenType", {0, 10, 0, 7}, 2, H5T_STD_I32LE);
    write_values(file, "Subhalo/SubhaloLenType", {0, 4, 0, 3, 0, 5}, 2, H5T_STD_I32LE);
    write_values(file, "Subhalo/SubhaloGroupNr", {0, 0, 1}, 1, H5T_STD_I32LE);
  }
  const HaloMembers second = read_halo(path / "Subhalo", 1, 1),
                    third = read_halo(path / "Subhalo", 2, 1);
  EXPECT_FALSE(second.has_place(3) || second.has_place(7));
  EXPECT_TRUE(second.has_place(4) && second.has_place(6));
  EXPECT_TRUE(third.has_place(10) && third.has_place(14));
  EXPECT_FALSE(third.has_place(9) || third.has_place(15));
  EXPECT_THAT(refusal_of_halo(path / "Subhalo", 3), HasSubstr("from 0 to 2"));
  EXPECT_THAT(refusal_of_halo(path / "Group", 0), HasSubstr("Subhalo for the subhaloes"));
}

TEST_F(HaloLists, OfSoapAreTheMembersBesideTheProperties) {
  const auto properties = folder_ / "halo_properties_0033.hdf5";
  {
    const Hdf5Output file = create_hdf5(properties);
    write_values(file, "InputHalos/HaloCentre", {1, 2, 3}, 3);
  }
  EXPECT_THAT(refusal_of_halo(properties, 2), HasSubstr("membership files"));
  {
    const Hdf5Output file = create_hdf5(folder_ / "membership_0033.hdf5");
    write_values(file, "PartType1/GroupNr_bound", {2, -1, 2, 0}, 1, H5T_STD_I64LE);
  }
  const HaloMembers members = read_halo(properties, 2, 1);
  EXPECT_TRUE(members.has_place(0) && members.has_place(2));
  EXPECT_FALSE(members.has_place(1) || members.has_place(3));
}

TEST_F(HaloLists, AreFoundByTheNumberOfTheSnapshot) {
  for (const char* const name :
       {"groups_033/fof_subhalo_tab_033.0.hdf5", "fof_tab_033.hdf5", "groups_033.hdf5",
        "membership_033/membership_033.0.hdf5", "SOAP/membership_033.hdf5",
        "snapshot_033.z0.000.AHF_particles", "snapshot_033.z0.000.AHF_halos", "out_33.list",
        "rockstar/halos_33.0.particles"}) {
    const auto catalog = write(name, "");
    EXPECT_THAT(find_halo_catalog(folder_ / "snapshot_033.0.hdf5"), Optional(catalog));
    EXPECT_FALSE(find_halo_catalog(folder_ / "snapshot_034.hdf5")) << name;
    std::filesystem::remove(catalog);
  }
}

TEST_F(HaloLists, AreFoundWhereRedshiftsAreInNames) {
  const auto catalog = write("groups_033.hdf5", "");
  EXPECT_THAT(find_halo_catalog(folder_ / "snapshot_033_z003p000.0.hdf5"), Optional(catalog));
}

TEST_F(HaloLists, OfTwoThatMayBeMeantNoneIsTaken) {
  write("snap_1.z0.000.AHF_particles", "");
  write("snap_1.z1.000.AHF_particles", "");
  EXPECT_FALSE(find_halo_catalog(folder_ / "snap_1.hdf5"));
}

}  // namespace
}  // namespace splotchcl::test
