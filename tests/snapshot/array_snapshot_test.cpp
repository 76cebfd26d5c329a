// Snapshots of arrays, and those that keep what was read.
#include "splotchcl/array_snapshot.h"

#include "scene/scalar_map.h"
#include "snapshot/derived_snapshots.h"
#include "snapshot/field_names.h"
#include "snapshot/load_memory.h"
#include "snapshot/memory_snapshot.h"
#include "splotchcl/image_file.h"
#include "splotchcl/load.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

TEST(ArraySnapshot, FloatsAreBorrowed) {
  std::vector<float> position = {1, 2, 3, 4, 5, 6};
  ArraySnapshot snapshot;
  snapshot.set_field(0, "position", position.data(), 2, 3);
  EXPECT_EQ(snapshot.read(0, "position").data(), position.data());
  position[4] = 50;
  EXPECT_EQ(snapshot.read(0, "position")[4], 50);
  EXPECT_EQ(snapshot.info().find_type(0)->count, 2u);
}

TEST(ArraySnapshot, AnOwnerIsKeptAsLongAsItsValuesAreHad) {
  auto owner = std::make_shared<const std::vector<float>>(2, 5.0F);
  ArraySnapshot snapshot;
  snapshot.set_field(0, "mass", owner->data(), 2, 1, owner);
  Column column = snapshot.read(0, "mass");
  const std::weak_ptr<const std::vector<float>> kept = std::exchange(owner, nullptr);
  snapshot.clear(0);
  EXPECT_EQ(column[1], 5);
  column = {};
  EXPECT_TRUE(kept.expired());
}

TEST(ArraySnapshot, AFilesNamesForAFieldFindIt) {
  const std::vector<float> values = {1, 2};
  ArraySnapshot snapshot;
  snapshot.set_field(0, "HSML", values.data(), 2);
  EXPECT_EQ(snapshot.read(0, "smoothing_length")[1], 2);
  EXPECT_EQ(snapshot.read(0, "SmoothingLength")[1], 2);
}

TEST(ArraySnapshot, AUnitIsThatOfTheFieldUntilItIsSetAgain) {
  const std::vector<float> values = {1, 2};
  ArraySnapshot snapshot;
  EXPECT_THROW(snapshot.set_unit(0, "Density", "g/cm^3"), UsageError);
  snapshot.set_field(0, "Density", values.data(), 2);
  snapshot.set_unit(0, "Density", "g/cm^3");
  EXPECT_EQ(require_field(snapshot.info(), 0, "density").unit, "g/cm^3");
  snapshot.set_field(0, "Mass", values.data(), 2);
  EXPECT_EQ(require_field(snapshot.info(), 0, "density").unit, "g/cm^3");
  snapshot.set_field(0, "Density", values.data(), 2);
  EXPECT_EQ(require_field(snapshot.info(), 0, "density").unit, "");
}

TEST(ArraySnapshot, DoublePositionsKeepTheirOffsetsFromTheOrigin) {
  const std::vector<double> position = {1e9 + 0.25, -1e9, 3};
  ArraySnapshot snapshot;
  snapshot.set_position_origin({{1e9, -1e9, 0}});
  snapshot.set_field(1, "position", position.data(), 1, 3);
  EXPECT_EQ(snapshot.read(1, "position")[0], 0.25F);
  EXPECT_EQ(snapshot.read(1, "position")[1], 0);
  EXPECT_THROW(snapshot.set_position_origin({{0, 0, 0}}), UsageError);
}

TEST(ArraySnapshot, WhatWasComputedOfItIsForgottenWhenItChanges) {
  ArraySnapshot snapshot;
  int computed = 0;
  const auto compute = [&] { snapshot.memory().get<int>("what", [&] { return ++computed; }); };
  compute();
  compute();
  EXPECT_EQ(computed, 1);
  snapshot.set_position_origin({{1, 2, 3}});
  compute();
  EXPECT_EQ(computed, 2);
  snapshot.set_time(0.5);
  compute();
  EXPECT_EQ(computed, 3);
}

TEST(ArraySnapshot, CountsOfATypeAgree) {
  const std::vector<float> values(9);
  ArraySnapshot snapshot;
  snapshot.set_field(0, "position", values.data(), 3, 3);
  EXPECT_THROW(snapshot.set_field(0, "mass", values.data(), 2), UsageError);
  snapshot.set_field(4, "mass", values.data(), 2);
  snapshot.clear(0);
  snapshot.set_field(0, "mass", values.data(), 2);
  EXPECT_EQ(snapshot.info().find_type(0)->count, 2u);
}

TEST(ArraySnapshot, WhatIsNoFieldIsRefused) {
  const std::vector<float> values(9);
  const float* const nothing = nullptr;
  ArraySnapshot snapshot;
  EXPECT_THROW(snapshot.set_field(-1, "mass", values.data(), 2), UsageError);
  EXPECT_THROW(snapshot.set_field(0, "", values.data(), 2), UsageError);
  EXPECT_THROW(snapshot.set_field(0, "mass", values.data(), 2, 2), UsageError);
  EXPECT_THROW(snapshot.set_field(0, "position", values.data(), 2, 1), UsageError);
  EXPECT_THROW(snapshot.set_field(0, "mass", nothing, 2), UsageError);
}

std::shared_ptr<test::MemorySnapshot> some_particles() {
  const auto snapshot = std::make_shared<test::MemorySnapshot>();
  snapshot->add(0, "position", {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1, 2, 0, 1}, 3);
  snapshot->add(0, "velocity", {3, 4, 0, 0, 0, 1, 6, 8, 0, 1, 0, 0, 0, 2, 0}, 3);
  snapshot->add(0, "mass", {1, 2, 3, 4, 5});
  snapshot->add(0, "internal_energy", {1, 10, 100, 1000, 10000});
  return snapshot;
}

Scene scene_left_to_the_data() {
  Scene scene;
  scene.image.width = 64;
  scene.image.height = 32;
  Component gas;
  gas.name = "gas";
  gas.color = {"internal_energy", Scaling::log, {}, {}};
  gas.intensity = {"velocity", Scaling::linear, {}, 5.0};
  scene.components = {gas};
  return scene;
}

Frame load(const Scene& scene, const Snapshot& snapshot) {
  std::vector<std::string> notes;
  return load_frame(scene, snapshot, notes);
}

Scene decided_as_scene(const Scene& scene, const Snapshot& snapshot) {
  std::vector<std::string> notes;
  return fixed_scene(decide(scene, snapshot, notes));
}

TEST(CachedSnapshot, ReadsEachColumnOnce) {
  const auto source = some_particles();
  const CachedSnapshot cached(source);
  for (int frame = 0; frame < 3; ++frame)
    load(scene_left_to_the_data(), cached);
  std::vector<std::string> fields = source->fields_read();
  std::sort(fields.begin(), fields.end());
  EXPECT_THAT(fields, ElementsAre("internal_energy", "mass", "position", "velocity"));
}

TEST(CachedSnapshot, FindsSmoothingLengthsOnce) {
  const CachedSnapshot cached(some_particles());
  const Frame first = load(scene_left_to_the_data(), cached);
  const Frame second = load(scene_left_to_the_data(), cached);
  EXPECT_EQ(first.components[0].particles.smoothing_length.data(),
            second.components[0].particles.smoothing_length.data());
}

TEST(CachedSnapshot, KnowsAFieldByAllItsNames) {
  const auto source = some_particles();
  const CachedSnapshot cached(source);
  EXPECT_EQ(cached.read(0, "U").data(), cached.read(0, "internal_energy").data());
  EXPECT_EQ(source->fields_read().size(), 1U);
}

TEST(CachedSnapshot, RemembersThePictureBehindEverything) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "sky.png";
  write_image(file, Image(4, 2));
  Scene scene = scene_left_to_the_data();
  scene.image.background_image = file.string();
  const CachedSnapshot cached(some_particles());
  const Frame first = load(scene, cached);
  std::filesystem::remove(file);
  EXPECT_EQ(load(scene, cached).background_image, first.background_image);
}

TEST(DecideScene, LeavesNothingToTheData) {
  const auto snapshot = some_particles();
  const Scene scene = scene_left_to_the_data();
  const Scene decided = decided_as_scene(scene, *snapshot);
  ASSERT_TRUE(decided.camera);
  const Component& gas = decided.components[0];
  EXPECT_TRUE(gas.color.minimum && gas.color.maximum && gas.intensity.minimum);
  EXPECT_EQ(gas.intensity.maximum, 5.0);
  EXPECT_EQ(gas.weight, WeightModel::mass);
  EXPECT_TRUE(gas.reference_column);
}

// Up to the rounding of 10^log10(x), and of the camera's axes.
TEST(DecideScene, DescribesTheSameFrame) {
  const auto snapshot = some_particles();
  const Scene scene = scene_left_to_the_data();
  const Frame open = load(scene, *snapshot);
  const Frame decided = load(decided_as_scene(scene, *snapshot), *snapshot);
  const DrawnComponent &a = open.components[0], &b = decided.components[0];
  EXPECT_NEAR(a.color.minimum, b.color.minimum, 1e-14);
  EXPECT_NEAR(a.color.maximum, b.color.maximum, 1e-14);
  EXPECT_EQ(a.intensity.minimum, b.intensity.minimum);
  EXPECT_EQ(a.reference_column, b.reference_column);
  EXPECT_NEAR(open.camera.focal_pixels / decided.camera.focal_pixels, 1, 1e-14);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(open.camera.position.a[axis], decided.camera.position.a[axis]);
    EXPECT_NEAR(open.camera.right.a[axis], decided.camera.right.a[axis], 1e-14);
    EXPECT_NEAR(open.camera.down.a[axis], decided.camera.down.a[axis], 1e-14);
  }
}

TEST(DecideScene, KeepsWhatTheSceneSays) {
  const auto snapshot = some_particles();
  Scene scene = scene_left_to_the_data();
  scene.components[0].color.minimum = 2;
  scene.components[0].weight = WeightModel::constant;
  scene.components[0].reference_column = 7;
  const Scene decided = decided_as_scene(scene, *snapshot);
  EXPECT_EQ(decided.components[0].color.minimum, 2);
  EXPECT_EQ(decided.components[0].weight, WeightModel::constant);
  EXPECT_EQ(decided.components[0].reference_column, 7);
}

// A later frame of a film decides it.
TEST(DecideScene, LeavesOpenWhatTheFrameShowsNothingOf) {
  const auto snapshot = some_particles();
  Scene scene = scene_left_to_the_data();
  scene.components[0].select.where = {"internal_energy > 1e9"};
  const Scene nothing_selected = decided_as_scene(scene, *snapshot);
  EXPECT_FALSE(is_decided(nothing_selected));
  EXPECT_FALSE(nothing_selected.components[0].color.minimum);
  EXPECT_FALSE(nothing_selected.components[0].reference_column);

  scene = scene_left_to_the_data();
  scene.camera = Camera();
  scene.camera->position = {{0, 0, 10}};
  scene.camera->look_at = {{0, 0, 20}};
  const Scene nothing_seen = decided_as_scene(scene, *snapshot);
  EXPECT_TRUE(nothing_seen.components[0].color.minimum);
  EXPECT_FALSE(nothing_seen.components[0].reference_column);

  scene.camera->look_at = {{0, 0, 0}};
  EXPECT_TRUE(is_decided(decided_as_scene(scene, *snapshot)));
}

TEST(Unscaled, UndoesTheScaling) {
  for (const Scaling scaling : {Scaling::linear, Scaling::log, Scaling::asinh}) {
    for (const double value : {1e-12, 0.3, 1.0, 7e9})
      EXPECT_NEAR(unscaled(scaled(value, scaling), scaling) / value, 1, 1e-14);
  }
}

}  // namespace
}  // namespace splotchcl::test
