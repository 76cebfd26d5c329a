// The two steps from a scene to a frame: deciding what the scene leaves open, and loading.
#include "snapshot/memory_snapshot.h"
#include "splotchcl/load.h"
#include "testing.h"

namespace splotchcl {
namespace {

using test::MemorySnapshot;
using ::testing::UnorderedElementsAre;

MemorySnapshot some_gas() {
  MemorySnapshot snapshot;
  snapshot.add(0, "position", {0, 0, 0, 1, 0, 0, 0, 1, 0, 0.3F, 0.9F, 0.7F, 2, 0, 1}, 3);
  snapshot.add(0, "smoothing_length", {1, 1, 0.5F, 2, 1});
  snapshot.add(0, "mass", {1, 2, 3, 4, 5});
  snapshot.add(0, "internal_energy", {1, 10, 100, 1000, 10000});
  return snapshot;
}

Scene open_scene() {
  Scene scene;
  scene.image.width = 64;
  scene.image.height = 48;
  Component gas;
  gas.name = "gas";
  gas.color = {"internal_energy", Scaling::log, {}, {}};
  scene.components = {gas};
  return scene;
}

// Everything is said but for what the test opens again.
Scene closed_scene() {
  Scene scene = open_scene();
  scene.camera = Camera();
  scene.camera->position = {{0, -20, 0}};
  Component& gas = scene.components[0];
  gas.color.minimum = 1;
  gas.color.maximum = 1e4;
  gas.weight = WeightModel::mass;
  gas.reference_column = 7;
  return scene;
}

DecidedScene decided(const Scene& scene, const Snapshot& snapshot) {
  std::vector<std::string> notes;
  return decide(scene, snapshot, notes);
}

Frame loaded(const DecidedScene& scene, const Snapshot& snapshot) {
  std::vector<std::string> notes;
  return load(scene, snapshot, notes);
}

void expect_same(const Vec3& a, const Vec3& b) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_EQ(a.a[axis], b.a[axis]);
}

void expect_same(const CameraFrame& a, const CameraFrame& b) {
  expect_same(a.position, b.position);
  expect_same(a.right, b.right);
  expect_same(a.down, b.down);
  expect_same(a.forward, b.forward);
  EXPECT_EQ(a.focal_pixels, b.focal_pixels);
  EXPECT_EQ(a.look_at_distance, b.look_at_distance);
}

void expect_same(const Column& a, const Column& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_EQ(a[i], b[i]);
}

TEST(Decide, SaysThatNothingIsDrawnToLessThanAMillionth) {
  const MemorySnapshot snapshot = some_gas();
  Scene scene = closed_scene();
  for (const double tolerance : {0.0, 1e-6, 1e-8}) {
    scene.tolerance = tolerance;
    std::vector<std::string> notes;
    load_frame(scene, snapshot, notes);
    const auto says_so = Contains(HasSubstr("found 1e-08, which is drawn as 0"));
    if (tolerance == 1e-8) {
      EXPECT_THAT(notes, says_so);
    } else {
      EXPECT_THAT(notes, Not(says_so));
    }
  }
}

TEST(Decide, ReadsNothingWhereNothingIsOpen) {
  const MemorySnapshot snapshot = some_gas();
  decided(closed_scene(), snapshot);
  EXPECT_THAT(snapshot.fields_read(), IsEmpty());
}

TEST(Decide, ReadsTheFieldAloneForItsRange) {
  const MemorySnapshot snapshot = some_gas();
  Scene scene = closed_scene();
  scene.components[0].color.maximum.reset();
  const DecidedScene found = decided(scene, snapshot);
  EXPECT_THAT(snapshot.fields_read(), ElementsAre("internal_energy"));
  EXPECT_EQ(found.components[0].color.minimum, 0);
  EXPECT_NEAR(found.components[0].color.maximum, 4, 0.1);
}

TEST(Decide, ReadsNothingForTheWeightModel) {
  const MemorySnapshot snapshot = some_gas();
  Scene scene = closed_scene();
  scene.components[0].weight.reset();
  EXPECT_EQ(decided(scene, snapshot).components[0].weight, WeightModel::mass);
  EXPECT_THAT(snapshot.fields_read(), IsEmpty());
}

TEST(Decide, FindsTheCameraByPositionsAlone) {
  const MemorySnapshot snapshot = some_gas();
  const Camera camera = decide_camera(open_scene(), snapshot);
  EXPECT_THAT(snapshot.fields_read(), ElementsAre("position"));
  const Camera same = *decided(open_scene(), snapshot).scene.camera;
  expect_same(camera.position, same.position);
  expect_same(camera.look_at, same.look_at);
  EXPECT_EQ(camera.field_of_view_degrees, same.field_of_view_degrees);
}

TEST(Decide, KeepsTheSceneAndTellsWhatItFound) {
  const MemorySnapshot snapshot = some_gas();
  const DecidedScene found = decided(open_scene(), snapshot);
  EXPECT_FALSE(found.scene.components[0].reference_column);
  EXPECT_FALSE(found.scene.components[0].color.minimum);
  EXPECT_TRUE(found.components[0].has_particles);
  EXPECT_TRUE(found.components[0].is_seen);
  EXPECT_GT(found.components[0].reference_column, 0);
}

// Finding lengths among neighbors takes long.
TEST(Decide, ForgetsNothingThatFramesAskFor) {
  MemorySnapshot snapshot;
  snapshot.add(0, "position", {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1, 2, 0, 1}, 3);
  snapshot.add(0, "internal_energy", {1, 10, 100, 1000, 10000});
  const auto lengths = [&snapshot] {
    std::vector<std::string> notes;
    return load_frame(open_scene(), snapshot, notes).components[0].particles.smoothing_length;
  };
  const Column first = lengths();
  for (int time = 0; time < 5; ++time)
    decided(closed_scene(), snapshot);
  EXPECT_EQ(lengths().data(), first.data());
}

TEST(Load, GivesTheFrameOfBothStepsAtOnce) {
  const MemorySnapshot snapshot = some_gas();
  for (const Scene& scene : {open_scene(), closed_scene()}) {
    std::vector<std::string> notes;
    const Frame at_once = load_frame(scene, snapshot, notes);
    const Frame in_steps = loaded(decided(scene, snapshot), snapshot);
    expect_same(at_once.camera, in_steps.camera);
    const DrawnComponent &a = at_once.components.at(0), &b = in_steps.components.at(0);
    EXPECT_EQ(a.weight, b.weight);
    EXPECT_EQ(a.color.minimum, b.color.minimum);
    EXPECT_EQ(a.color.maximum, b.color.maximum);
    EXPECT_EQ(a.reference_column, b.reference_column);
    expect_same(a.particles.position, b.particles.position);
    expect_same(a.particles.weight, b.particles.weight);
    expect_same(a.particles.color, b.particles.color);
    expect_same(a.particles.smoothing_length, b.particles.smoothing_length);
  }
}

TEST(Load, TakesTheNumbersThatAreDecided) {
  const MemorySnapshot snapshot = some_gas();
  DecidedScene other = decided(open_scene(), snapshot);
  other.components[0].color = {Scaling::log, -1, 9};
  other.components[0].weight = WeightModel::constant;
  other.components[0].reference_column = 42;
  const DrawnComponent drawn = loaded(other, snapshot).components.at(0);
  EXPECT_EQ(drawn.color.minimum, -1);
  EXPECT_EQ(drawn.color.maximum, 9);
  EXPECT_EQ(drawn.weight, WeightModel::constant);
  EXPECT_TRUE(drawn.particles.weight.is_absent());
  EXPECT_EQ(drawn.reference_column, 42);
}

TEST(Load, RefusesASceneThatIsNotDecided) {
  const MemorySnapshot snapshot = some_gas();
  EXPECT_THROW(loaded({open_scene(), {DecidedComponent()}}, snapshot), UsageError);
  EXPECT_THROW(loaded({closed_scene(), {}}, snapshot), UsageError);
}

TEST(LoadFrame, ReadsForBothStepsOnce) {
  const MemorySnapshot snapshot = some_gas();
  Scene scene = open_scene();
  scene.camera = closed_scene().camera;
  std::vector<std::string> notes;
  load_frame(scene, snapshot, notes);
  EXPECT_THAT(snapshot.fields_read(),
              UnorderedElementsAre("position", "smoothing_length", "mass", "internal_energy"));
}

TEST(FixedScene, HasTheVeryCameraThatWasDecided) {
  const MemorySnapshot snapshot = some_gas();
  const DecidedScene found = decided(open_scene(), snapshot);
  const Frame open = loaded(found, snapshot);
  const Frame fixed = loaded(decided(fixed_scene(found), snapshot), snapshot);
  expect_same(open.camera, fixed.camera);
}

}  // namespace
}  // namespace splotchcl
