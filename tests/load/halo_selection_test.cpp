// Haloes of catalogs beside a snapshot's files.
#include "formats/hdf5/hdf5_values.h"
#include "formats/hdf5/snapshot_hdf5_writer.h"
#include "load/particles.h"
#include "splotchcl/read_settings.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

using namespace splotchcl::test;

// Gas 37, dark matter 20, stars 11; the catalog has two haloes, of 30 and 5 particles of gas.
class HaloSelection : public ::testing::Test {
 protected:
  HaloSelection() {
    write_hdf5(folder_ / "snap_099.hdf5", small_snapshot());
    write_catalog({30, 0, 0, 0, 0, 0, 5, 0, 0, 0, 2, 0});
  }
  void write_catalog(const std::vector<double>& lengths) const {
    const Hdf5Output file = create_hdf5(folder_ / "fof_subhalo_tab_099.hdf5");
    make_group(file, "Header");
    write_attribute(file, "Header", "Ngroups_Total", {2});
    write_values(file, "Group/GroupLenType", lengths, 6, H5T_STD_I32LE);
  }
  std::unique_ptr<Snapshot> open(const ReadSettings& read = {}) const {
    return open_snapshot_for(folder_ / "snap_099.hdf5", read);
  }
  Component of_halo(int number) const {
    Component component = gas();
    component.select.halo = number;
    return component;
  }
  // The masses of gas tell which particles they are.
  std::vector<float> masses(const Snapshot& snapshot) const {
    return values(snapshot.read(0, "mass"));
  }
  const TemporaryFolder folder_;
};

TEST_F(HaloSelection, TakesTheParticlesThatTheCatalogBesideTheSnapshotSays) {
  const auto snapshot = open();
  const std::vector<float> all = masses(*snapshot);
  EXPECT_EQ(values(load(of_halo(1), *snapshot).particles.weight),
            std::vector<float>(all.begin() + 30, all.begin() + 35));
  EXPECT_THAT(notes_of(of_halo(1), *snapshot),
              Contains(HasSubstr("halo 1 is looked up in " +
                                 (folder_ / "fof_subhalo_tab_099.hdf5").string())));
}

TEST_F(HaloSelection, OfAPartOfTheParticlesTakesThoseOfTheHaloAmongThem) {
  ReadSettings every_third;
  every_third.every = 3;
  const auto whole = open(), part = open(every_third);
  const std::vector<float> all = masses(*whole);
  EXPECT_EQ(values(load(of_halo(1), *part).particles.weight),
            (std::vector<float>{all[30], all[33]}));
}

TEST_F(HaloSelection, OfAnotherSnapshotsCatalogIsRefused) {
  write_catalog({30, 0, 0, 0, 0, 0, 8, 0, 0, 0, 2, 0});
  EXPECT_THAT(refusal(of_halo(1), *open()), HasSubstr("belongs to another snapshot"));
}

TEST_F(HaloSelection, ThatIsNotInTheCatalogIsRefused) {
  EXPECT_THAT(refusal(of_halo(2), *open()), HasSubstr("expected a number from 0 to 1"));
}

}  // namespace
}  // namespace splotchcl::test
