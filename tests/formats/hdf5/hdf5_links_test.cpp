// Files that lead to others: followed where those lie beside them, and never waited for.
#include <sys/stat.h>

#include "formats/hdf5/hdf5_values.h"
#include "formats/hdf5/snapshot_hdf5_writer.h"
#include "formats/snapshot_checks.h"
#include "formats/snapshot_writer.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

class Hdf5Leads : public ::testing::Test {
 protected:
  Hdf5Leads() {
    snapshot_.counts = {4, 0, 0, 0, 0, 0};
    add_block(snapshot_, "POS", 1U, 3);
    add_block(snapshot_, "RHO", 1U, 1);
    write_hdf5(folder_ / "snap.hdf5", snapshot_);
    std::filesystem::create_directories(folder_ / "below");
    std::filesystem::create_directories(other_.path());
    for (const auto& path : {folder_ / "part", folder_ / "below" / "part", other_ / "part"})
      write_hdf5(path, snapshot_);
    ::mkfifo((folder_ / "fifo").c_str(), 0600);
  }
  // In place of the densities.
  void link_to(const std::string& file) const {
    const Hdf5Handle<H5Fclose> snap(open_to_write());
    H5Ldelete(snap.id(), "PartType0/Density", H5P_DEFAULT);
    H5Lcreate_external(file.c_str(), "PartType0/Density", snap.id(), "PartType0/Density",
                       H5P_DEFAULT, H5P_DEFAULT);
  }
  void make_virtual(const std::string& file) const {
    const Hdf5Handle<H5Fclose> snap(open_to_write());
    H5Ldelete(snap.id(), "PartType0/Density", H5P_DEFAULT);
    const bool is_pattern = file.find('%') != std::string::npos;
    const hsize_t start = 0, most = H5S_UNLIMITED, block = 4;
    const Hdf5Handle<H5Sclose> all(H5Screate_simple(1, &block, is_pattern ? &most : nullptr));
    if (is_pattern) H5Sselect_hyperslab(all.id(), H5S_SELECT_SET, &start, &block, &most, &block);
    const Hdf5Handle<H5Sclose> source(H5Screate_simple(1, &block, nullptr));
    const Hdf5Handle<H5Pclose> properties(H5Pcreate(H5P_DATASET_CREATE));
    H5Pset_virtual(properties.id(), all.id(), file.c_str(), "PartType0/Density", source.id());
    const Hdf5Handle<H5Dclose> dataset(H5Dcreate2(snap.id(), "PartType0/Density", H5T_IEEE_F32LE,
                                                  all.id(), H5P_DEFAULT, properties.id(),
                                                  H5P_DEFAULT));
    ASSERT_TRUE(dataset.is_valid());
  }
  // A file whose densities lie elsewhere than in the snapshot.
  void write_other_part(const std::filesystem::path& path) const {
    const Hdf5Output file = create_hdf5(path);
    write_values(file, "before", std::vector<double>(1000, 1), 1, H5T_IEEE_F32LE);
    write_values(file, "PartType0/Density", {5, 6, 7, 8}, 1, H5T_IEEE_F32LE);
  }
  bool has_densities() const {
    const auto snapshot = open();
    for (const FieldInfo& field : snapshot->info().types.front().fields) {
      if (field.name == "density") return snapshot->read(0, "density").size() == 4;
    }
    return false;
  }
  std::unique_ptr<Snapshot> open() const { return open_snapshot(folder_ / "snap.hdf5"); }

  TestSnapshot snapshot_;
  TemporaryFolder folder_;
  TemporaryFolder other_{"other"};

 private:
  Hdf5Handle<H5Fclose> open_to_write() const {
    return Hdf5Handle<H5Fclose>(
        H5Fopen((folder_ / "snap.hdf5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT));
  }
};

TEST_F(Hdf5Leads, AreFollowedToFilesBesideAndBelow) {
  for (const std::string file : {"part", "below/part", "./part"}) {
    link_to(file);
    EXPECT_TRUE(has_densities()) << file;
  }
  link_to((folder_ / "part").string());
  EXPECT_TRUE(has_densities());
}

TEST_F(Hdf5Leads, AreFilesThatTheSnapshotIsReadFrom) {
  link_to("part");
  EXPECT_THAT(open()->info().files_beside, Contains(folder_ / "part"));
}

TEST_F(Hdf5Leads, AreReadFromTheFileThatTheyLeadTo) {
  write_other_part(folder_ / "other_part");
  link_to("other_part");
  EXPECT_THAT(values_of(open()->read(0, "density")), ElementsAre(5, 6, 7, 8));
}

TEST_F(Hdf5Leads, MayLeadToVirtualDatasetsWithFilesBesideThese) {
  write_other_part(folder_ / "below" / "source");
  make_virtual("source");
  std::filesystem::rename(folder_ / "snap.hdf5", folder_ / "below" / "virtual");
  write_hdf5(folder_ / "snap.hdf5", snapshot_);
  link_to("below/virtual");
  EXPECT_THAT(values_of(open()->read(0, "density")), ElementsAre(5, 6, 7, 8));
}

TEST_F(Hdf5Leads, MayLeadToMoreThanTheirOwnFileHolds) {
  {
    const Hdf5Output part = create_hdf5(folder_ / "many");
    write_values(part, "pos", std::vector<double>(30000, 1), 3, H5T_IEEE_F32LE);
    const Hdf5Output file = create_hdf5(folder_ / "links");
    H5Lcreate_external("many", "pos", file.id(), "pos", H5P_DEFAULT, H5P_DEFAULT);
  }
  EXPECT_EQ(open_snapshot(folder_ / "links")->read(0, "position").size(), 30000U);
}

TEST_F(Hdf5Leads, ToOtherFoldersAreNotFollowedAndSaid) {
  const std::string up = "../" + other_.path().filename().string() + "/part";
  for (const std::string& file : {(other_ / "part").string(), up, "below/../" + up}) {
    link_to(file);
    EXPECT_FALSE(has_densities()) << file;
    EXPECT_THAT(open()->info().notes, Contains(HasSubstr(file)));
  }
}

TEST_F(Hdf5Leads, ToNothingAreSaid) {
  {
    const Hdf5Output part = create_hdf5(folder_ / "empty");
    const Hdf5Output file = create_hdf5(folder_ / "links");
    write_values(file, "pos", {1, 2, 3, 4, 5, 6}, 3, H5T_IEEE_F32LE);
    H5Lcreate_soft("/gone/m", file.id(), "m", H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_external("empty", "h", file.id(), "h", H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_external("lost", "u", file.id(), "u", H5P_DEFAULT, H5P_DEFAULT);
  }
  EXPECT_THAT(
      open_snapshot(folder_ / "links")->info().notes,
      ::testing::UnorderedElementsAre("/h, a link to empty: h, is left out: nothing is there",
                                      "/m, a link to /gone/m, is left out: nothing is there",
                                      "/u, a link to lost: u, is left out: nothing is there"));
  link_to("lost");
  EXPECT_THAT(open()->info().notes,
              Contains(HasSubstr("Density, a link to lost: PartType0/Density, is left out")));
}

// In groups of other names than Gadget's.
TEST_F(Hdf5Leads, OfFilesWithoutAHeaderAreFollowedAndSaidToo) {
  for (const std::string group : {"", "particles/"}) {  // plain, and after sphNG
    const std::string positions = group + (group.empty() ? "pos" : "xyz");
    {
      const Hdf5Output part = create_hdf5(folder_ / "part");
      write_values(part, "pos", {1, 2, 3, 4, 5, 6}, 3, H5T_IEEE_F32LE);
      const Hdf5Output file = create_hdf5(folder_ / "links");
      write_values(file, group + "h", {1, 2});
      H5Lcreate_external("part", "pos", file.id(), positions.c_str(), H5P_DEFAULT, H5P_DEFAULT);
      H5Lcreate_external("/elsewhere", "u", file.id(), (group + "u").c_str(), H5P_DEFAULT,
                         H5P_DEFAULT);
    }
    const auto snapshot = open_snapshot(folder_ / "links");
    EXPECT_EQ(snapshot->read(0, "position").size(), 6U) << group;
    EXPECT_THAT(snapshot->info().files_beside, Contains(folder_ / "part")) << group;
    EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("/elsewhere"))) << group;
  }
}

TEST_F(Hdf5Leads, ToFifosAndDevicesAreNotWaitedFor) {
  for (const std::string file : {"fifo", "/dev/zero"}) {
    link_to(file);
    EXPECT_FALSE(has_densities()) << file;
  }
}

TEST_F(Hdf5Leads, OfVirtualDatasetsToFifosAreRefused) {
  make_virtual("fifo");
  EXPECT_THROW(open(), DataError);
}

TEST_F(Hdf5Leads, OfPatternsToFifosAreRefused) {
  std::filesystem::copy_file(folder_ / "part", folder_ / "part_0");
  ::mkfifo((folder_ / "part_1").c_str(), 0600);
  make_virtual("part_%b");
  EXPECT_THROW(open(), DataError);
}

}  // namespace
}  // namespace splotchcl::test
