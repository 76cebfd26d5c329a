#include "splotchcl/snapshot_source.h"

#include "formats/snapshot_writer.h"
#include "sequence/interpolated_snapshot.h"
#include "snapshot/snapshot_files.h"
#include "splotchcl/load.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/snapshot.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Sequences of files: which snapshots a moment needs, and that reading ahead changes nothing.

// snap_002, snap_004, snap_005 and snap_006 of one run; 003 is missing.
class Sequence : public ::testing::Test {
 protected:
  Sequence() {
    for (const int number : {2, 4, 5, 6}) {
      TestSnapshot snapshot = small_snapshot();
      snapshot.time = 0.1 * number;
      snapshot.redshift = 1 / snapshot.time - 1;
      for (auto& positions : snapshot.block("POS").values) {
        for (double& x : positions)
          x += 0.125 * number * number;
      }
      write_gadget(folder_ / fill_pattern("snap_%03d", number), snapshot, 2);
    }
  }
  Scene scene(double index, Interpolation interpolation = Interpolation::linear) const {
    Scene scene;
    scene.time.pattern = (folder_ / "snap_%03d").string();
    scene.time.index = index;
    scene.time.interpolation = interpolation;
    return scene;
  }
  std::unique_ptr<Snapshot> file(int number) const {
    return open_snapshot(folder_ / fill_pattern("snap_%03d", number));
  }

  TemporaryFolder folder_;
};

std::vector<float> column(const Snapshot& snapshot, int type, const std::string& field) {
  const Column column = snapshot.read(type, field);
  return {column.data(), column.data() + column.size()};
}

void expect_same_snapshot(const Snapshot& a, const Snapshot& b) {
  ASSERT_EQ(a.info().types.size(), b.info().types.size());
  EXPECT_EQ(a.info().time, b.info().time);
  for (const ParticleTypeInfo& type : b.info().types) {
    EXPECT_EQ(a.read_ids(type.type), b.read_ids(type.type));
    for (const FieldInfo& field : type.fields) {
      EXPECT_EQ(column(a, type.type, field.name), column(b, type.type, field.name)) << field.name;
    }
  }
}

TEST_F(Sequence, HoldsASnapshotExactlyAtItsIndex) {
  SnapshotSource source;
  source.at(scene(4.5));
  expect_same_snapshot(*source.at(scene(4)), *file(4));
  expect_same_snapshot(*source.at(scene(5)), *file(5));
  expect_same_snapshot(*source.at(scene(6)), *file(6));
}

TEST_F(Sequence, CountsByTheNumbersOfAPattern) {
  SnapshotSource source;
  // 004 and 005 hold 2 and 3.125 more than the plain positions.
  const float plain = column(*file(4), 0, "position")[0] - 2;
  EXPECT_FLOAT_EQ(column(*source.at(scene(4.5)), 0, "position")[0], plain + 2.5625F);
  // Halfway from 002 to 004, since there is no 003.
  EXPECT_FLOAT_EQ(column(*source.at(scene(3)), 0, "position")[0], plain + 1.25F);
}

TEST_F(Sequence, CountsAListFromZero) {
  Scene scene;
  scene.time.snapshots = {(folder_ / "snap_005").string(), (folder_ / "snap_002").string()};
  scene.time.index = 1;
  expect_same_snapshot(*SnapshotSource().at(scene), *file(2));
}

TEST_F(Sequence, WithoutInterpolationHasTheEarlierSnapshot) {
  expect_same_snapshot(*SnapshotSource().at(scene(4.9, Interpolation::none)), *file(4));
}

TEST_F(Sequence, InterpolatesTimeAndRedshift) {
  const auto snapshot = SnapshotSource().at(scene(4.25));
  EXPECT_NEAR(snapshot->info().time, 0.425, 1e-12);
  EXPECT_NEAR(*snapshot->info().redshift, 1 / 0.425 - 1, 1e-12);
}

TEST_F(Sequence, GivesTheSameObjectForTheSameMoment) {
  SnapshotSource source;
  const auto first = source.at(scene(4.25));
  EXPECT_EQ(source.at(scene(4.25)), first);
  EXPECT_NE(source.at(scene(4.5)), first);
}

// Read ahead or not, forwards, backwards and jumping: every frame is what it would be alone.
TEST_F(Sequence, IsTheSameInAnyOrderOfFrames) {
  SnapshotSource film;
  for (const double index :
       {2.0, 2.5, 3.5, 4.0, 4.5, 5.25, 5.75, 6.0, 5.5, 4.75, 4.25, 2.25, 5.5}) {
    SCOPED_TRACE(index);
    const auto frame = film.at(scene(index));
    frame->read(0, "density");
    expect_same_snapshot(*frame, *SnapshotSource().at(scene(index)));
  }
}

// By particles, wherever they are in either file; and the list is read once for all moments.
TEST_F(Sequence, SelectsByIdsBetweenSnapshots) {
  const int gas = 0;
  const std::uint64_t wanted = file(4)->read_ids(gas).at(1);
  std::ofstream(folder_ / "ids.txt") << wanted << "\n";
  Scene selecting = scene(4.5);
  selecting.components.emplace_back();
  selecting.components[0].size_fixed = 1;
  selecting.components[0].select.id_file = (folder_ / "ids.txt").string();
  SnapshotSource source;
  std::vector<std::string> notes;
  for (const double index : {4.5, 4.75, 5.25}) {
    selecting.time.index = index;
    const std::shared_ptr<const Snapshot> moment = source.at(selecting);
    const std::vector<std::uint64_t> ids = moment->read_ids(gas);
    const auto place = std::find(ids.begin(), ids.end(), wanted) - ids.begin();
    const Frame frame = load_frame(selecting, *moment, notes);
    ASSERT_EQ(frame.components[0].particles.count, 1U);
    EXPECT_EQ(frame.components[0].particles.position[0],
              moment->read(gas, "position")[3 * static_cast<std::size_t>(place)]);
    std::filesystem::remove(folder_ / "ids.txt");
  }
}

TEST_F(Sequence, OutOfRangeIsRefused) {
  for (const double index : {1.5, 6.001, -1.0}) {
    EXPECT_THAT([&] { SnapshotSource().at(scene(index)); },
                ThrowsMessage<UsageError>(HasSubstr("expected a number from 2")));
  }
}

TEST_F(Sequence, WithoutFilesIsRefused) {
  Scene none = scene(0);
  none.time.pattern = (folder_ / "snapshot_%03d").string();
  EXPECT_THROW(SnapshotSource().at(none), UsageError);
  Scene missing;
  missing.time.snapshots = {(folder_ / "snap_002").string(), (folder_ / "snap_003").string()};
  EXPECT_THROW(SnapshotSource().at(missing), UsageError);
}

TEST_F(Sequence, OfDifferentRunsIsRefusedBeforeItsFirstFrame) {
  TestSnapshot stranger = small_snapshot();
  for (auto& ids : stranger.block("ID").values) {
    for (double& id : ids)
      id += 1e6;
  }
  write_gadget(folder_ / "snap_007", stranger, 2);
  SnapshotSource source;
  EXPECT_NO_THROW(source.at(scene(4.5)));
  EXPECT_THROW(source.check(scene(4.5)), DataError);
  EXPECT_THROW(source.at(scene(6.5)), DataError);
  Scene good = scene(4.5);
  good.time.last = 6;
  EXPECT_NO_THROW(source.check(good));
}

TEST_F(Sequence, IsReadFromASceneFile) {
  write_bytes(folder_ / "scene.toml",
              "[time]\nsnapshots = \"snap_%03d\"\nindex = 4.5\ninterpolation = \"hermite\"\n"
              "[[component]]\ntypes = 0\n");
  const Scene scene = read_scene_file(folder_ / "scene.toml", {"time.index=5.5"});
  EXPECT_EQ(scene.time.index, 5.5);
  EXPECT_EQ(scene.time.interpolation, Interpolation::hermite);
  EXPECT_EQ(scene.time.pattern, (folder_ / "snap_%03d").string());
}

std::vector<double> numbers_of(const std::string& pattern, int first, int last) {
  SequenceSettings settings;
  settings.pattern = pattern;
  settings.first = first;
  settings.last = last;
  std::vector<double> numbers;
  for (const ListedSnapshot& listed : list_snapshots(settings))
    numbers.push_back(listed.index);
  return numbers;
}

TEST_F(Sequence, MayHaveNumbersUpToTheLargestThatATimeHas) {
  EXPECT_THAT(numbers_of((folder_ / "snap_%03d").string(), 3, 999999999), ElementsAre(4, 5, 6));
}

TEST(SequencesOfTables, CrossTheFacesOfTheBoxThatTheSceneSays) {
  const TemporaryFolder folder;
  std::ofstream(folder / "t_0.csv") << "x,y,z,id\n98,5,5,1\n40,5,5,2\n";
  std::ofstream(folder / "t_1.csv") << "x,y,z,id\n2,5,5,1\n44,5,5,2\n";
  SnapshotSource source;
  const auto first_x = [&](const std::optional<BoxSides>& box) {
    Scene scene;
    scene.time.pattern = (folder / "t_%d.csv").string();
    scene.time.index = 0.25;
    scene.periodic.box = box;
    const std::shared_ptr<const Snapshot> moment = source.at(scene);
    return moment->position_origin().a[0] + static_cast<double>(column(*moment, 0, "position")[0]);
  };
  EXPECT_EQ(first_x({}), 74);
  EXPECT_EQ(first_x(BoxSides(Vec3{{100, 10, 10}})), 99);
  EXPECT_EQ(first_x({}), 74);
}

TEST(SnapshotPatterns, FindTheNumbersOfTheNamesThatAreThere) {
  const TemporaryFolder folder;
  const auto find = [&folder](const std::string& pattern) {
    return numbers_of((folder / pattern).string(), 0, 999999999);
  };
  for (const std::string name : {"dir_7", "dir_12", "dir_x"})
    std::filesystem::create_directory(folder / name);
  for (const std::string name :
       {"dir_7/a_0007", "dir_12/a_0012.hdf5", "s_0", "s_120", "s_999999999", "t_000.1.hdf5",
        "t_000.0.hdf5", "t_010.h5", "t_10", "u_  3", "100%_5"})
    write_bytes(folder / name, "data");
  EXPECT_THAT(find("dir_%d/a_%04d"), ElementsAre(7, 12));
  EXPECT_THAT(find("s_%d"), ElementsAre(0, 120, 999999999));
  EXPECT_THAT(find("s_%d0"), ElementsAre(12));
  EXPECT_THAT(find("t_%03d"), ElementsAre(0, 10));
  EXPECT_THAT(find("u_%3d"), ElementsAre(3));
  EXPECT_THAT(find("100%%_%d"), ElementsAre(5));
}

TEST(SnapshotPatterns, HaveANumberAndNothingElse) {
  EXPECT_EQ(fill_pattern("a_%03d.hdf5", 7), "a_007.hdf5");
  EXPECT_EQ(fill_pattern("dir_%d/a_%04d", 12), "dir_12/a_0012");
  EXPECT_EQ(fill_pattern("100%%_%d", 3), "100%_3");
  EXPECT_TRUE(is_snapshot_pattern("a%03d"));
  for (const char* const wrong : {"a", "a%s", "a%", "a%03", "100%%", "a%d%n"})
    EXPECT_FALSE(is_snapshot_pattern(wrong)) << wrong;
}

// Real runs: a snapshot that was left out is predicted from its neighbours.

const std::filesystem::path data = test::data_folder();

std::shared_ptr<const SequenceMember> open(const std::string& name) {
  return std::make_shared<SequenceMember>(open_snapshot(data / name));
}

double time_of(const SequenceMember& member) {
  const SnapshotInfo& info = member.info();
  return info.cosmology ? info.cosmology->scale_factor : info.time;
}

// The root mean square distance between predicted and real positions of one type.
double miss(const std::string& before, const std::string& left_out, const std::string& after,
            int type, Interpolation interpolation) {
  const auto first = open(before), real = open(left_out), second = open(after);
  const double fraction = (time_of(*real) - time_of(*first)) / (time_of(*second) - time_of(*first));
  SequenceSettings settings;
  settings.interpolation = interpolation;
  const InterpolatedSnapshot predicted(make_pair(first, second, settings), fraction);
  const IdMatch match = match_ids(predicted.read_ids(type), real->read_ids(type));
  const Column at = predicted.read(type, "position"), is = real->read(type, "position");
  const double box = real->info().box_size.value_or(1e30).longest();
  double sum = 0;
  for (std::size_t i = 0; i < match.place_in_second.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double d = static_cast<double>(at[3 * i + axis]) -
                       static_cast<double>(is[3 * match.place_in_second[i] + axis]);
      sum += std::pow(d - box * std::round(d / box), 2);
    }
  }
  return std::sqrt(sum / static_cast<double>(match.in_common));
}

class RealSequences : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory(data)) GTEST_SKIP() << "no real snapshots in " << data;
  }
};

TEST_F(RealSequences, OfTheUniverseAreBetterPredictedWithVelocities) {
  for (const int type : {0, 1}) {
    const auto predict = [type](Interpolation interpolation) {
      return miss("lcdm/fmt2_snapshot_004", "lcdm/fmt2_snapshot_005", "lcdm/fmt2_snapshot_006",
                  type, interpolation);
    };
    const double linear = predict(Interpolation::linear);
    const double hermite = predict(Interpolation::hermite);
    RecordProperty("linear_" + std::to_string(type), std::to_string(linear));
    RecordProperty("hermite_" + std::to_string(type), std::to_string(hermite));
    EXPECT_LT(hermite, linear) << "type " << type;
  }
}

TEST_F(RealSequences, OfTwoGalaxiesMatchEveryParticle) {
  const auto pair = make_pair(open("galaxy_collision/snapshot_000.hdf5"),
                              open("galaxy_collision/snapshot_005.hdf5"), SequenceSettings());
  EXPECT_EQ(pair->matches.at(1)->in_common, 40000U);
  EXPECT_EQ(pair->matches.at(2)->in_common, 20000U);
  EXPECT_TRUE(pair->notes.empty());
}

}  // namespace
}  // namespace splotchcl::test
