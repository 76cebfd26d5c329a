#include "formats/snapshot_checks.h"
#include "snapshot/derived_snapshots.h"
#include "snapshot/memory_snapshot.h"
#include "splotchcl/load.h"
#include "splotchcl/reference.h"
#include "splotchcl/scene_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

using test::MemorySnapshot;
using ::testing::Lt;

// Particles 0, 1, 2, ... of a type, with positions and masses that say which they are.
void add_numbered(MemorySnapshot& snapshot, int type, int count) {
  std::vector<float> position, mass;
  for (int i = 0; i < count; ++i) {
    const float x = static_cast<float>(i);
    position.insert(position.end(), {x, x + 0.25F, x + 0.5F});
    mass.push_back(x);
  }
  snapshot.add(type, "position", position, 3);
  snapshot.add(type, "mass", mass);
}

std::shared_ptr<const Snapshot> numbered(int gas, int stars) {
  const auto snapshot = std::make_shared<MemorySnapshot>();
  add_numbered(*snapshot, 0, gas);
  add_numbered(*snapshot, 4, stars);
  return snapshot;
}

ReadSettings every(int n) {
  ReadSettings read;
  read.every = n;
  return read;
}

ReadSettings at_most(int n, int seed = 1) {
  ReadSettings read;
  read.max_particles = n;
  read.seed = seed;
  return read;
}

TEST(Subset, EveryNthOfEachTypeIsRead) {
  const SubsetSnapshot subset(numbered(10, 5), every(4));
  EXPECT_THAT(values_of(subset.read(0, "mass")), ElementsAre(0, 4, 8));
  EXPECT_THAT(values_of(subset.read(4, "position")), ElementsAre(0, 0.25F, 0.5F, 4, 4.25F, 4.5F));
  EXPECT_EQ(subset.info().find_type(0)->count, 3U);
  EXPECT_DOUBLE_EQ(subset.info().find_type(0)->particles_per_drawn, 10.0 / 3);
  EXPECT_DOUBLE_EQ(subset.info().find_type(4)->particles_per_drawn, 5.0 / 2);
  EXPECT_THAT(subset.info().notes, Contains(HasSubstr("only 5 of 15 particles")));
}

TEST(Subset, AtMostSoManyAreReadInTheShareOfTheirTypes) {
  const SubsetSnapshot subset(numbered(3000, 1000), at_most(400));
  EXPECT_EQ(subset.info().find_type(0)->count, 300U);
  EXPECT_EQ(subset.info().find_type(4)->count, 100U);
  for (const int type : {0, 4})
    EXPECT_EQ(subset.info().find_type(type)->particles_per_drawn, 10);
}

TEST(Subset, TheSameSeedChoosesTheSameParticlesForEveryField) {
  const auto whole = numbered(3000, 1000);
  const SubsetSnapshot subset(whole, at_most(400)), again(whole, at_most(400)),
      other(whole, at_most(400, 2));
  const std::vector<float> masses = values_of(subset.read(0, "mass"));
  EXPECT_EQ(values_of(again.read(0, "mass")), masses);
  EXPECT_NE(values_of(other.read(0, "mass")), masses);
  const Column positions = subset.read(0, "position");
  for (std::size_t i = 0; i < masses.size(); ++i)
    EXPECT_EQ(positions[3 * i], masses[i]);
  // Each from a run of its own: none twice, all parts of the file.
  EXPECT_EQ(std::set<float>(masses.begin(), masses.end()).size(), 300U);
  for (std::size_t i = 0; i < masses.size(); ++i)
    EXPECT_EQ(static_cast<std::size_t>(masses[i]) / 10, i);
}

TEST(Subset, AsManyAsThereAreIsAll) {
  const SubsetSnapshot subset(numbered(30, 10), at_most(1000));
  EXPECT_EQ(subset.read(0, "mass").size(), 30U);
  EXPECT_TRUE(subset.info().is_whole());
  EXPECT_THAT(subset.info().notes, IsEmpty());
}

// Clouds of equal mass, all of their light within the picture.
void add_cloud(MemorySnapshot& snapshot, int type, std::size_t count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(-1, 1);
  std::vector<float> positions(3 * count);
  for (float& x : positions)
    x = uniform(random);
  snapshot.add(type, "position", positions, 3);
  snapshot.add(type, "smoothing_length", std::vector<float>(count, 0.25F));
  snapshot.add(type, "mass", std::vector<float>(count, 1));
}

std::shared_ptr<const Snapshot> cloud() {
  const auto snapshot = std::make_shared<MemorySnapshot>();
  add_cloud(*snapshot, 0, 3000);
  return snapshot;
}

double light(const Scene& scene, const Snapshot& snapshot) {
  std::vector<std::string> notes;
  const Image image = reference::render(load_frame(scene, snapshot, notes)).to_float();
  double sum = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x)
      sum += static_cast<double>(image.at(x, y)[0]);
  }
  return sum;
}

// A picture without absorption, whose light is a sum.
Scene scene_of_light() {
  Scene scene = parse_scene(
      "[image]\nsize = [32, 32]\n[camera]\nprojection = 'orthographic'\nposition = [0, 0, -9]\n"
      "look_at = [0, 0, 0]\nfield_of_view = 30\n[[component]]\nabsorption = 'none'\n"
      "palette = 'white'\nreference_column = 40\n",
      "scene");
  scene.snapshot = "memory";
  return scene;
}

// Of 7 stars every tenth is one.
TEST(SubsetPictures, GiveRareTypesTheLightThatTheyHave) {
  const auto whole = std::make_shared<MemorySnapshot>();
  add_cloud(*whole, 0, 3000);
  add_cloud(*whole, 4, 7);
  Scene scene = scene_of_light();
  for (const std::vector<int>& types : {std::vector<int>{4}, std::vector<int>{0, 4}}) {
    scene.components.front().types = types;
    for (const WeightModel weight : {WeightModel::mass, WeightModel::constant}) {
      scene.components.front().weight = weight;
      const double all = light(scene, *whole);
      EXPECT_NEAR(light(scene, SubsetSnapshot(whole, every(10))) / all, 1, 1e-5);
      EXPECT_NEAR(light(scene, SubsetSnapshot(whole, at_most(100))) / all, 1, 1e-5);
    }
  }
}

TEST(SubsetPictures, AreAsBrightAsThoseOfAllParticles) {
  for (const char* weight : {"mass", "constant"}) {
    const Scene scene =
        apply_settings(scene_of_light(), {std::string("component.0.weight=") + weight});
    const auto whole = cloud();
    const double all = light(scene, *whole);
    EXPECT_GT(all, 1);
    // All clouds have the same light, and single precision of the pictures is far finer.
    EXPECT_NEAR(light(scene, SubsetSnapshot(whole, every(10))) / all, 1, 1e-5);
    EXPECT_NEAR(light(scene, SubsetSnapshot(whole, at_most(500))) / all, 1, 1e-5);
  }
}

TEST(SubsetPictures, KeepTheReferenceThatIsDecidedForAFilm) {
  Scene scene = parse_scene(
      "[image]\nsize = [32, 32]\n[camera]\nposition = [0, 0, -9]\nlook_at = [0, 0, 0]\n"
      "[[component]]\nname = 'gas'\n",
      "scene");
  scene.snapshot = "memory";
  const SubsetSnapshot subset(cloud(), every(10));
  std::vector<std::string> notes;
  const Frame first = load_frame(scene, subset, notes);
  const Frame second = load_frame(fixed_scene(decide(scene, subset, notes)), subset, notes);
  EXPECT_DOUBLE_EQ(second.components[0].reference_column, first.components[0].reference_column);
}

}  // namespace
}  // namespace splotchcl::test
