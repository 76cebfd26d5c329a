// How particles move between snapshots, and steps in time.
#include "formats/hdf5/hdf5_values.h"
#include "formats/hdf5/snapshot_hdf5_writer.h"
#include "formats/snapshot_writer.h"
#include "sequence/moving_snapshot.h"
#include "sequence/snapshot_source.h"
#include "splotchcl/load.h"
#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"
#include "splotchcl/snapshot_file.h"
#include "splotchcl/snapshot_source.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

using ::testing::ElementsAreArray;
using ::testing::FloatEq;

// Particles that only one of two snapshots has, or that cannot be told apart.

// 1 vanishes, 2 stays, 3 appears.
std::shared_ptr<const SequenceMember> before() {
  return MovingSnapshot(0)
      .ids(0, {1, 2})
      .positions(0, {5, 5, 5, 0, 0, 0})
      .field(0, "mass", {10, 20})
      .field(0, "smoothing_length", {1, 1})
      .make();
}
std::shared_ptr<const SequenceMember> after() {
  return MovingSnapshot(1)
      .ids(0, {3, 2})
      .positions(0, {9, 9, 9, 4, 0, 0})
      .field(0, "mass", {30, 20})
      .field(0, "smoothing_length", {1, 1})
      .make();
}

TEST(Strangers, FadeWhereTheyAre) {
  const InterpolatedSnapshot snapshot = between(before(), after(), 0.25);
  EXPECT_EQ(snapshot.info().types[0].count, 3U);
  EXPECT_THAT(snapshot.read_ids(0), ElementsAre(1, 2, 3));
  EXPECT_THAT(values(snapshot, "position"), ElementsAre(5, 5, 5, 1, 0, 0, 9, 9, 9));
  EXPECT_THAT(values(snapshot, "mass"), ElementsAre(10, 20, 30));
  EXPECT_THAT(values(snapshot, fade_field), ElementsAre(0.75F, 1, 0.25F));
}

Component gas(WeightModel weight) {
  Component component;
  component.weight = weight;
  component.reference_column = 1;
  return component;
}

std::vector<float> weights_drawn(WeightModel model) {
  Scene scene;
  scene.components = {gas(model)};
  scene.camera = Camera{};
  scene.camera->position = {{0, 0, -10}};
  scene.camera->look_at = {{0, 0, 0}};
  std::vector<std::string> notes;
  const Frame frame = load_frame(scene, between(before(), after(), 0.25), notes);
  const Column weight = frame.components[0].particles.weight;
  return {weight.data(), weight.data() + weight.size()};
}

TEST(Strangers, FadeInEveryWeight) {
  EXPECT_THAT(weights_drawn(WeightModel::mass), ElementsAre(7.5F, 20, 7.5F));
  EXPECT_THAT(weights_drawn(WeightModel::constant), ElementsAre(0.75F, 1, 0.25F));
}

TEST(Strangers, OfATypeThatOneSnapshotLacksFade) {
  auto first = MovingSnapshot(0).ids(0, {1, 2}).positions(0, {0, 0, 0, 1, 1, 1}).make();
  auto second = MovingSnapshot(1)
                    .ids(0, {1})
                    .ids(4, {2})
                    .positions(0, {0, 0, 0})
                    .positions(4, {1, 1, 1})
                    .make();
  const InterpolatedSnapshot snapshot = between(first, second, 0.25);
  EXPECT_THAT(values(snapshot, fade_field, 0), ElementsAre(1, 0.75F));
  EXPECT_THAT(values(snapshot, fade_field, 4), ElementsAre(0.25F));
  EXPECT_THAT(values(snapshot, "position", 4), ElementsAre(1, 1, 1));
}

TEST(Strangers, MoveOnAlongTheirVelocityWithHermite) {
  auto first = MovingSnapshot(0)
                   .ids(0, {1, 2})
                   .positions(0, {0, 0, 0, 10, 0, 0})
                   .velocities(0, {4, 0, 0, 1, 0, 0})
                   .make();
  auto second = MovingSnapshot(2)
                    .ids(0, {2, 3})
                    .positions(0, {12, 0, 0, 20, 0, 0})
                    .velocities(0, {1, 0, 0, 0, 8, 0})
                    .make();
  EXPECT_THAT(values(between(first, second, 0.25, Interpolation::hermite), "position"),
              ElementsAre(2, 0, 0, FloatEq(10.5), 0, 0, 20, -12, 0));
}

TEST(Strangers, AloneAreRefused) {
  const auto first = MovingSnapshot(0).ids(0, {1}).positions(0, {0, 0, 0}).make();
  const auto second = MovingSnapshot(1).ids(0, {2}).positions(0, {0, 0, 0}).make();
  EXPECT_THAT([&] { between(first, second, 0.5); },
              ThrowsMessage<DataError>(HasSubstr("snapshots of the same run")));
}

TEST(SharedIds, FadeAndAreNamed) {
  auto first = MovingSnapshot(0).ids(0, {4, 4, 5}).positions(0, {0, 0, 0, 1, 0, 0, 2, 0, 0}).make();
  auto second = MovingSnapshot(1).ids(0, {4, 5}).positions(0, {8, 0, 0, 4, 0, 0}).make();
  const InterpolatedSnapshot snapshot = between(first, second, 0.5);
  EXPECT_THAT(values(snapshot, "position"), ElementsAre(0, 0, 0, 1, 0, 0, 3, 0, 0, 8, 0, 0));
  EXPECT_THAT(values(snapshot, fade_field), ElementsAre(0.5F, 0.5F, 1, 0.5F));
  EXPECT_THAT(snapshot.info().notes, Contains(HasSubstr("share their id")));
}

TEST(Acquaintances, HaveNothingThatFades) {
  const auto make = [] { return MovingSnapshot(0).ids(0, {1}).positions(0, {0, 0, 0}).make(); };
  const InterpolatedSnapshot snapshot = between(make(), make(), 0.5);
  EXPECT_EQ(find_field(snapshot.info().types[0], fade_field), nullptr);
  EXPECT_THAT(snapshot.info().notes, IsEmpty());
}

// What snapshots tell of the expansion and of their velocities.

TEST(SnapshotMotion, IsCosmologicalWhereTheTimeIsTheScaleFactor) {
  const TemporaryFolder folder;
  const TestSnapshot snapshot = small_snapshot();  // time 0.5, redshift 1, Omega0 0.3
  write_gadget(folder / "snap", snapshot, 2);
  write_hdf5(folder / "snap.hdf5", snapshot);
  for (const char* const name : {"snap", "snap.hdf5"}) {
    SCOPED_TRACE(name);
    const auto opened = open_snapshot(folder / name);
    ASSERT_TRUE(opened->info().cosmology);
    EXPECT_EQ(opened->info().cosmology->scale_factor, 0.5);
    EXPECT_EQ(opened->info().cosmology->omega_matter, 0.3);
    EXPECT_EQ(opened->info().cosmology->velocity_power, 0.5);
    // 100 h km/s/Mpc in km/s per kpc/h.
    EXPECT_NEAR(opened->info().cosmology->hubble_rate, 0.1, 1e-12);
  }
}

TEST(SnapshotMotion, IsNewtonianWhereTimeAndRedshiftDisagree) {
  const TemporaryFolder folder;
  TestSnapshot snapshot = small_snapshot();
  snapshot.redshift = 0;  // with a time of 0.5
  write_gadget(folder / "snap", snapshot, 2);
  EXPECT_FALSE(open_snapshot(folder / "snap")->info().cosmology);
}

TEST(SnapshotMotion, IsNewtonianWithoutMatterDensity) {
  const TemporaryFolder folder;
  TestSnapshot snapshot = small_snapshot();
  snapshot.omega_matter = 0;
  write_gadget(folder / "snap", snapshot, 2);
  EXPECT_FALSE(open_snapshot(folder / "snap")->info().cosmology);
}

TEST(RealSnapshotMotion, FollowsTheUnitsOfEachCode) {
  const std::filesystem::path data = test::data_folder();
  if (!std::filesystem::is_directory(data)) GTEST_SKIP() << "no real snapshots in " << data;
  const auto gadget = open_snapshot(data / "lcdm/fmt2_snapshot_005");
  ASSERT_TRUE(gadget->info().cosmology);
  EXPECT_EQ(gadget->info().cosmology->omega_lambda, 0.7);
  const auto swift = open_snapshot(data / "swift/swift_lcdm_0000.hdf5");
  ASSERT_TRUE(swift->info().cosmology);
  // Mpc without h and km/s, with h = 0.7; peculiar velocities; the file says 69.99999997.
  EXPECT_NEAR(swift->info().cosmology->hubble_rate, 70, 1e-5);
  EXPECT_EQ(swift->info().cosmology->velocity_power, 0);
  EXPECT_NEAR(swift->info().cosmology->scale_factor, 0.98, 1e-9);
  EXPECT_FALSE(open_snapshot(data / "galaxy_collision/snapshot_005.hdf5")->info().cosmology);
  EXPECT_FALSE(open_snapshot(data / "gassphere/fmt2_snapshot_004")->info().cosmology);
}

// Ids are read exactly: single precision, as other fields have it, would mix up particles.

constexpr std::uint64_t beyond_doubles = (std::uint64_t{1} << 53) - 1;

// Neighbouring numbers that single precision cannot tell apart.
TestSnapshot snapshot_with_large_ids() {
  TestSnapshot snapshot = small_snapshot();
  snapshot.set_kind("ID", ValueKind::uint64);
  for (std::vector<double>& ids : snapshot.block("ID").values) {
    for (std::size_t i = 0; i < ids.size(); ++i)
      ids[i] = static_cast<double>(beyond_doubles - i);
  }
  return snapshot;
}

std::vector<std::uint64_t> counted_down(std::size_t count) {
  std::vector<std::uint64_t> ids;
  for (std::size_t i = 0; i < count; ++i)
    ids.push_back(beyond_doubles - i);
  return ids;
}

TEST(Ids, AreExactIn64BitsInEveryFormatAndEndianness) {
  const TemporaryFolder folder;
  const TestSnapshot snapshot = snapshot_with_large_ids();
  write_gadget(folder / "one", snapshot, 1);
  write_gadget(folder / "two", snapshot, 2);
  write_gadget(folder / "swapped", snapshot, 2, true);
  write_hdf5(folder / "snapshot.hdf5", snapshot);
  for (const char* const name : {"one", "two", "swapped", "snapshot.hdf5"}) {
    SCOPED_TRACE(name);
    const auto opened = open_snapshot(folder / name);
    EXPECT_THAT(opened->read_ids(0), ElementsAreArray(counted_down(snapshot.counts[0])));
    EXPECT_THAT(opened->read_ids(4), ElementsAreArray(counted_down(snapshot.counts[4])));
  }
}

TEST(Ids, OfSeveralFilesFollowEachOther) {
  const TemporaryFolder folder;
  const TestSnapshot snapshot = snapshot_with_large_ids();
  write_gadget_set(folder / "set", split(snapshot, 3), 2);
  EXPECT_THAT(open_snapshot(folder / "set")->read_ids(1),
              ElementsAreArray(counted_down(snapshot.counts[1])));
}

TEST(Ids, ThatAreNotThereAreRefused) {
  const TemporaryFolder folder;
  TestSnapshot snapshot = small_snapshot();
  snapshot.remove("ID");
  write_gadget(folder / "snap", snapshot, 2);
  const auto opened = open_snapshot(folder / "snap");
  EXPECT_THAT([&] { opened->read_ids(0); },
              ThrowsMessage<DataError>(HasSubstr("particles of type 0 have no ids")));
}

TEST(Ids, ThatAreNotWholeNumbersAreRefused) {
  const TemporaryFolder folder;
  TestSnapshot snapshot = small_snapshot();
  snapshot.set_kind("ID", ValueKind::float32);
  snapshot.block("ID").values[0][0] += 0.5;
  write_hdf5(folder / "snap.hdf5", snapshot);
  EXPECT_THROW(open_snapshot(folder / "snap.hdf5")->read_ids(0), DataError);
}

// Sequences of steps in one file, and of files whose columns have to be named.

class SequenceOfSteps : public ::testing::Test {
 protected:
  SequenceOfSteps() {
    const Hdf5Output file = create_hdf5(file_);
    for (const int step : {0, 5, 20, 12000}) {
      const std::string group = "data/" + std::to_string(step);
      write_values(file, group + "/particles/gas/pos", {1, 2, 3, 4, 5, 6}, 3);
      write_values(file, group + "/particles/gas/ids", {7, 8}, 1, H5T_STD_U64LE);
      write_values(file, group + "/particles/gas/mass", {step + 1.0, step + 3.0});
      write_attribute(file, group, "time", {0.5 * step});
    }
  }
  Scene scene(const std::string& pattern, double index) const {
    Scene scene;
    scene.time.pattern = (folder_ / pattern).string();
    scene.time.index = index;
    return scene;
  }
  static std::vector<double> indices(const Scene& scene) {
    std::vector<double> found;
    for (const ListedSnapshot& listed : list_sequence(scene.time))
      found.push_back(listed.index);
    return found;
  }
  const TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "run.h5";
};

TEST_F(SequenceOfSteps, HasThoseThatTheFileHas) {
  EXPECT_THAT(indices(scene("run.h5/data/%d", 0)), ElementsAre(0, 5, 20, 12000));
  Scene some = scene("run.h5/data/%d", 0);
  some.time.first = 1;
  some.time.last = 20;
  EXPECT_THAT(indices(some), ElementsAre(5, 20));
}

TEST_F(SequenceOfSteps, IsReadBetweenTwo) {
  SnapshotSource source;
  const auto between = source.at(scene("run.h5/data/%d", 12.5));
  EXPECT_EQ(between->info().time, 6.25);
  const Column mass = between->read(0, "mass");
  EXPECT_FLOAT_EQ(mass[0], 13.5F);
}

TEST_F(SequenceOfSteps, OfOtherNamesIsRefused) {
  EXPECT_THAT([&] { indices(scene("run.h5/steps/%d", 0)); },
              ThrowsMessage<UsageError>(HasSubstr("found no group %d in")));
  EXPECT_THAT([&] { indices(scene("run.h5/data/%07d", 0)); },
              ThrowsMessage<UsageError>(HasSubstr("found no group %07d in")));
}

TEST_F(SequenceOfSteps, MayHaveColumnsThatAreNamed) {
  for (const int number : {1, 2}) {
    write_bytes(folder_ / ("table_" + std::to_string(number) + ".txt"),
                "some words\n9 9\n" + std::to_string(number) + " 2 3\n");
  }
  Scene tables = scene("table_%d.txt", 2);
  tables.time.interpolation = Interpolation::none;
  tables.read.columns = {"x", "y", "z"};
  tables.read.skip_lines = 2;
  SnapshotSource source;
  source.check(tables);
  const auto second = source.at(tables);
  EXPECT_EQ(second->read(0, "position")[0] + second->position_origin().a[0], 2);
  tables.read.columns = {"y", "x", "z"};
  const auto otherwise = source.at(tables);
  EXPECT_EQ(otherwise->read(0, "position")[1] + otherwise->position_origin().a[1], 2);
}

}  // namespace
}  // namespace splotchcl::test
