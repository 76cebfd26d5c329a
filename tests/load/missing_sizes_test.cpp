#include <sys/resource.h>

#include <csignal>

#include "formats/snapshot_checks.h"
#include "load/particles.h"
#include "smoothing/smoothing_lengths.h"
#include "snapshot/memory_snapshot.h"
#include "splotchcl/load.h"
#include "splotchcl/palette_file.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

using namespace splotchcl::test;

// As long as it lives no file of this process gets a byte.
class FullDisk {
 public:
  FullDisk() {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit none = {0, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &none);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    ::signal(SIGXFSZ, handler_);
  }

 private:
  void (*handler_)(int) = ::signal(SIGXFSZ, SIG_IGN);
  rlimit before_ = {};
};

// Positions of dark matter in a file, without smoothing lengths.
class MissingSizes : public ::testing::Test {
 protected:
  void write(unsigned seed) const {
    TestSnapshot written;
    written.counts = {0, 500, 0, 0, 0, 0};
    add_block(written, "POS", 2U, 3);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (double& x : written.block("POS").values[1])
      x = uniform(random);
    write_gadget(path_, written, 2);
  }
  std::vector<float> lengths(const std::vector<std::string>& settings = {}) {
    Scene scene = parse_scene(
        "[camera]\nposition = [0, 0, -9]\nlook_at = [0, 0, 0]\n[[component]]\ntypes = [1]\n",
        "scene");
    scene = apply_settings(scene, settings);
    notes_.clear();
    const Frame frame = load_frame(scene, *open_snapshot_for(path_, scene.read), notes_);
    return values_of(frame.components[0].particles.smoothing_length);
  }
  std::vector<std::string> notes_;
  const TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "snap";
  const std::string keep_ = "read.cache_smoothing_lengths=true";
};

TEST_F(MissingSizes, ReachAsManyNeighborsAsTheSceneSays) {
  write(1);
  const std::vector<float> usual = lengths(), few = lengths({"read.neighbours=8"});
  EXPECT_EQ(lengths({"read.neighbours=64"}), usual);
  const auto snapshot = open_snapshot(path_);
  EXPECT_EQ(values_of(find_smoothing_lengths(snapshot->read(1, "position"), 500, 100, 8)), few);
}

TEST_F(MissingSizes, AreKeptOnlyWhenAsked) {
  write(1);
  lengths();
  EXPECT_EQ(folder_.count_files(), 1U);
  const std::vector<float> found = lengths({keep_});
  EXPECT_TRUE(std::filesystem::exists(folder_ / "snap.type1.smoothing_lengths"));
  EXPECT_EQ(lengths({keep_}), found);
  EXPECT_THAT(notes_, Contains(HasSubstr("are those kept in")));
}

TEST_F(MissingSizes, AreFoundAnewForOtherPositionsOrNeighbors) {
  write(1);
  const std::vector<float> first = lengths({keep_});
  EXPECT_NE(lengths({keep_, "read.neighbours=8"}), first);
  EXPECT_THAT(notes_, Not(Contains(HasSubstr("are those kept in"))));
  lengths({keep_});
  write(2);
  EXPECT_NE(lengths({keep_}), first);
  EXPECT_THAT(notes_, Not(Contains(HasSubstr("are those kept in"))));
}

TEST_F(MissingSizes, ThatWereDamagedAreFoundAnew) {
  write(1);
  const std::vector<float> found = lengths({keep_});
  const auto kept = folder_ / "snap.type1.smoothing_lengths";
  for (const std::uintmax_t size : {0U, 10U, 100U}) {
    std::filesystem::resize_file(kept, size);
    EXPECT_EQ(lengths({keep_}), found);
  }
}

TEST_F(MissingSizes, OfWhichAnyByteHasChangedAreFoundAnew) {
  write(1);
  const std::vector<float> found = lengths({keep_});
  const auto kept = folder_ / "snap.type1.smoothing_lengths";
  const std::string whole = read_text(kept);
  for (std::size_t place = 16; place < whole.size(); place += 97) {
    std::string damaged = whole;
    damaged[place] = static_cast<char>(damaged[place] ^ 2);
    std::ofstream(kept, std::ios::binary) << damaged;
    EXPECT_EQ(lengths({keep_}), found) << place;
    EXPECT_THAT(notes_, Not(Contains(HasSubstr("are those kept in"))));
  }
  EXPECT_EQ(read_text(kept), whole);
}

TEST_F(MissingSizes, AreNotKeptInAFileOfSomethingElse) {
  write(1);
  const std::string mine = "my own notes on this snapshot";
  std::ofstream(folder_ / "snap.type1.smoothing_lengths") << mine;
  lengths({keep_});
  EXPECT_THAT(notes_, Contains(HasSubstr("is another file")));
  EXPECT_EQ(read_text(folder_ / "snap.type1.smoothing_lengths"), mine);
}

TEST_F(MissingSizes, AreDrawnWhereTheyCannotBeKept) {
  write(1);
  const std::vector<float> found = lengths();
  std::vector<float> unkept;
  {
    const FullDisk full;
    unkept = lengths({keep_});
  }
  EXPECT_EQ(unkept, found);
  EXPECT_THAT(notes_, Contains(HasSubstr("are not kept")));
  EXPECT_EQ(folder_.count_files(), 1U);
}

TEST_F(MissingSizes, OfAPartOfTheParticlesAreNotKept) {
  write(1);
  lengths({keep_, "read.every=2"});
  EXPECT_EQ(folder_.count_files(), 1U);
  EXPECT_THAT(notes_, Contains(HasSubstr("are not kept")));
}

TEST_F(MissingSizes, KeptBesideTheSnapshotAreNoSnapshotThemselves) {
  write(1);
  lengths({keep_});
  EXPECT_EQ(open_snapshot(folder_.path())->info().files.front(), path_);
}

TEST(CellSizes, FollowFromTheirVolumes) {
  test::MemorySnapshot snapshot;
  snapshot.add(0, "position", {0, 0, 0, 1, 1, 1}, 3);
  snapshot.add(0, "volume", {1, 8});
  const Scene scene = parse_scene(
      "[camera]\nposition = [0, 0, -9]\nlook_at = [0, 0, 0]\n[[component]]\nname = 'gas'\n",
      "scene");
  std::vector<std::string> notes;
  const Frame frame = load_frame(scene, snapshot, notes);
  const Column& h = frame.components[0].particles.smoothing_length;
  // The sphere of 64 cells.
  const double expected = std::cbrt(3 * 64 / (4 * 3.14159265358979));
  EXPECT_NEAR(h[0], expected, 1e-6);
  EXPECT_NEAR(h[1], 2 * expected, 1e-6);
}

// A particle of each length, of 1e6 solar masses at 3e9 of them per cubic kiloparsec.
class SizesOfUnits : public ::testing::Test {
 protected:
  SizesOfUnits() {
    snapshot_.add(0, "position", {0, 0, 0, 1, 1, 1}, 3);
    snapshot_.add(0, "mass", {1e6F, 1e6F});
    snapshot_.set_unit(0, "position", "kpc");
    snapshot_.set_unit(0, "mass", "Msun");
  }
  void add_densities(float value, const std::string& unit) {
    snapshot_.add(0, "density", {value, value});
    snapshot_.set_unit(0, "density", unit);
  }
  double length() {
    const Scene scene = parse_scene(
        "[camera]\nposition = [0, 0, -9]\nlook_at = [0, 0, 0]\n[[component]]\nname = 'gas'\n",
        "scene");
    const Frame frame = load_frame(scene, snapshot_, notes_);
    return static_cast<double>(frame.components[0].particles.smoothing_length[0]);
  }
  test::MemorySnapshot snapshot_;
  std::vector<std::string> notes_;
};

TEST_F(SizesOfUnits, FollowFromDensitiesInAnyUnit) {
  add_densities(2.03037e-22F, "g/cm**3");
  EXPECT_NEAR(length(), std::cbrt(3 * 64 * 1e6 / (4 * 3.14159265 * 3e9)), 1e-5);
}

TEST_F(SizesOfUnits, FollowFromVolumesInAnyUnit) {
  snapshot_.add(0, "volume", {1e9F, 1e9F});
  snapshot_.set_unit(0, "volume", "pc^3");
  EXPECT_NEAR(length(), std::cbrt(3 * 64 / (4 * 3.14159265)), 1e-5);
}

TEST_F(SizesOfUnits, AreThoseOfNeighborsWhereUnitsCannotBeCompared) {
  add_densities(3e9F, "code_density");
  EXPECT_NEAR(length(), std::sqrt(3), 1e-6);
  EXPECT_THAT(notes_, Contains(HasSubstr("the unit of its densities is not comparable")));
}

// Selections and derived fields of real snapshots.

std::unique_ptr<Snapshot> open_real(const std::string& name) {
  const std::filesystem::path path = data_folder() / name;
  return std::filesystem::exists(path) ? open_snapshot(path) : nullptr;
}

TEST(RealSelection, DividesTheGasOfACosmologicalBox) {
  const auto snapshot = open_real("lcdm/fmt2_snapshot_006");
  if (!snapshot) GTEST_SKIP() << "no lcdm in " << data_folder();
  Component hot = gas(), rest = gas();
  hot.select.where = {"temperature > 1e5 or density > 1e-5"};
  hot.select.sphere_center = Vec3{{25000, 25000, 25000}};
  hot.select.sphere_radius = 20000;
  rest.exclude = hot.select;
  const std::size_t hot_count = load(hot, *snapshot).particles.count;
  EXPECT_GT(hot_count, 100u);
  EXPECT_EQ(hot_count + load(rest, *snapshot).particles.count, 32768u);
}

TEST(RealSelection, FindsEveryOtherOfIdsThatSinglePrecisionCannotHold) {
  const auto snapshot = open_real("gassphere_id64/fmt2_snapshot_001");
  if (!snapshot) GTEST_SKIP() << "no gassphere_id64 in " << data_folder();
  const splotchcl::test::TemporaryFolder folder;
  const std::vector<std::uint64_t> ids = snapshot->read_ids(0);
  ASSERT_GE(*std::min_element(ids.begin(), ids.end()), 1ull << 33);
  {
    std::ofstream list(folder / "ids.txt");
    for (std::size_t i = 0; i < ids.size(); i += 2)
      list << ids[i] << "\n";
  }
  Component component = gas();
  component.select.id_file = (folder / "ids.txt").string();
  const Column all = snapshot->read(0, "position");
  const Particles drawn = load(component, *snapshot).particles;
  ASSERT_EQ(drawn.count, (ids.size() + 1) / 2);
  for (std::size_t i = 0; i < drawn.count; ++i)
    ASSERT_EQ(drawn.position[3 * i], all[6 * i]) << i;
}

TEST(RealTemperature, OfACosmologicalBoxIsThatOfIntergalacticGas) {
  const auto snapshot = open_real("lcdm/fmt2_snapshot_006");
  if (!snapshot) GTEST_SKIP() << "no lcdm in " << data_folder();
  Component component = gas();
  component.color = {"temperature", Scaling::log, {}, {}};
  component.color.percentiles = {0, 100};
  const ScalarMap map = load(component, *snapshot).color;
  // Adiabatic gas without heating: from what is left of the early universe's warmth to what
  // falls into the largest cluster of so small a box.
  EXPECT_GT(map.minimum, -3);
  EXPECT_GT(map.maximum, 6);
  EXPECT_LT(map.maximum, 8.5);
}

}  // namespace
}  // namespace splotchcl::test
