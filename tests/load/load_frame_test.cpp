// From a scene and a snapshot to a frame: what is read, and how open numbers are decided.
#include "load/component_rows.h"
#include "load/particles.h"
#include "snapshot/memory_snapshot.h"
#include "splotchcl/load.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

INSTANTIATE_TEST_SUITE_P(Loaded, ComponentKeys,
                         ::testing::ValuesIn(component_rows("load/components.rows")),
                         name_of_component_row);

// A row of gas particles along x, all seen by the scene's camera.
MemorySnapshot centered_gas_row(int count = 5) {
  MemorySnapshot snapshot;
  std::vector<float> position, h, mass, energy;
  for (int i = 0; i < count; ++i) {
    position.insert(position.end(), {static_cast<float>(i - count / 2), 0, 0});
    h.push_back(1);
    mass.push_back(static_cast<float>(i + 1));
    energy.push_back(std::pow(10.0f, static_cast<float>(i)));
  }
  snapshot.add(0, "position", position, 3);
  snapshot.add(0, "smoothing_length", h);
  snapshot.add(0, "mass", mass);
  snapshot.add(0, "internal_energy", energy);
  return snapshot;
}

std::string refusal(const Scene& scene, const Snapshot& snapshot) {
  return refusal_by<Error>([&] { load(scene, snapshot); });
}

std::vector<float> values(const Column& column, std::size_t count) {
  std::vector<float> all;
  for (std::size_t i = 0; i < count; ++i)
    all.push_back(column[i]);
  return all;
}

TEST(LoadFrame, TakesPictureAndCameraFromTheScene) {
  Scene scene = scene_of({gas()});
  scene.image.background = {0.1, 0.2, 0.3};
  scene.camera->far_limit = 30;
  scene.tolerance = 0.01;
  const Frame frame = load(scene, centered_gas_row());
  EXPECT_EQ(frame.width, 64);
  EXPECT_EQ(frame.crop.width, 64);
  EXPECT_EQ(frame.crop.height, 48);
  EXPECT_EQ(frame.far_limit, 30);
  EXPECT_EQ(frame.background[2], 0.3);
  EXPECT_EQ(frame.tolerance, 0.01);
  EXPECT_EQ(frame.camera.look_at_distance, 20);
}

TEST(LoadFrame, ReadsOnlyWhatTheSceneUses) {
  MemorySnapshot snapshot = centered_gas_row();
  snapshot.add(0, "density", std::vector<float>(5, 1));
  snapshot.add(1, "position", std::vector<float>(15, 1), 3);
  load(gas(), snapshot);
  EXPECT_THAT(snapshot.fields_read(), Not(Contains("internal_energy")));
  EXPECT_THAT(snapshot.fields_read(), Not(Contains("density")));
  EXPECT_THAT(snapshot.fields_read(),
              ::testing::UnorderedElementsAre("position", "smoothing_length", "mass"));
}

TEST(LoadFrame, PassesTheFilesOwnMemoryOn) {
  const MemorySnapshot snapshot = centered_gas_row();
  EXPECT_EQ(load(gas(), snapshot).particles.position.data(), snapshot.read(0, "position").data());
}

TEST(LoadFrame, DrawsSeveralTypesOneAfterTheOther) {
  MemorySnapshot snapshot = centered_gas_row(3);
  snapshot.add(2, "position", {7, 8, 9, 4, 5, 6}, 3);
  snapshot.add(2, "smoothing_length", {0.5f, 0.25f});
  snapshot.set_table_mass(2, 40);
  Component component = gas();
  component.types = {2, 0};
  const DrawnComponent drawn = load(component, snapshot);
  ASSERT_EQ(drawn.particles.count, 5u);
  EXPECT_THAT(values(drawn.particles.smoothing_length, 5), ElementsAre(0.5f, 0.25f, 1, 1, 1));
  EXPECT_THAT(values(drawn.particles.weight, 5), ElementsAre(40, 40, 1, 2, 3));
  EXPECT_THAT(values(drawn.particles.position, 9), ElementsAre(7, 8, 9, 4, 5, 6, -1, 0, 0));
}

TEST(LoadFrame, KeepsTheOriginOfThePositions) {
  MemorySnapshot snapshot = centered_gas_row();
  snapshot.set_origin({{1000, 2000, 3000}});
  EXPECT_EQ(load(gas(), snapshot).particles.origin.a[1], 2000);
}

TEST(LoadFrame, NamesATypeThatTheSnapshotLacks) {
  Component component = gas();
  component.types = {4};
  EXPECT_THAT(refusal(scene_of({component}), centered_gas_row()),
              HasSubstr("no particles of type 4"));
  component.types = {0, 4};
  EXPECT_THAT(notes_of(component, centered_gas_row()),
              Contains(HasSubstr("no particles of type 4")));
}

TEST(LoadFrame, TellsOfAComponentWithoutANameByItsNumber) {
  Component component = gas();
  component.types = {0, 4};
  component.name.clear();
  std::vector<std::string> notes;
  const Frame frame = load_frame(scene_of({gas(), component}), centered_gas_row(), notes);
  EXPECT_THAT(notes, Contains(HasSubstr("component 1: ")));
  EXPECT_EQ(frame.components[0].name, "gas");
  EXPECT_EQ(frame.components[1].name, "1");
}

TEST(LoadFrame, RefusesASceneWithoutComponents) {
  EXPECT_THROW(load(scene_of({}), centered_gas_row()), UsageError);
}

TEST(LoadFrameWeight, IsTheMassWhereMassesAreKnown) {
  const DrawnComponent drawn = load(gas(), centered_gas_row());
  EXPECT_EQ(drawn.weight, WeightModel::mass);
  EXPECT_THAT(values(drawn.particles.weight, 5), ElementsAre(1, 2, 3, 4, 5));
}

TEST(LoadFrameWeight, OfATableMassIsOneValueForAll) {
  MemorySnapshot snapshot;
  snapshot.add(0, "position", std::vector<float>(9, 1), 3);
  snapshot.add(0, "smoothing_length", {1, 1, 1});
  snapshot.set_table_mass(0, 2.5);
  const DrawnComponent drawn = load(gas(), snapshot);
  EXPECT_EQ(drawn.weight, WeightModel::mass);
  EXPECT_TRUE(drawn.particles.weight.is_uniform());
  EXPECT_EQ(drawn.particles.weight[2], 2.5f);
}

TEST(LoadFrameWeight, IsConstantWhereNoMassIsKnown) {
  MemorySnapshot snapshot;
  snapshot.add(0, "position", std::vector<float>(9, 1), 3);
  snapshot.add(0, "smoothing_length", {1, 1, 1});
  const DrawnComponent drawn = load(gas(), snapshot);
  EXPECT_EQ(drawn.weight, WeightModel::constant);
  EXPECT_TRUE(drawn.particles.weight.is_absent());
  Component wants_mass = gas();
  wants_mass.weight = WeightModel::mass;
  EXPECT_THAT(refusal(scene_of({wants_mass}), snapshot), HasSubstr("have no masses"));
}

TEST(LoadFrameColor, ALimitBeyondAllDataKeepsThemBeyondIt) {
  Component component = gas();
  component.color = {"internal_energy", Scaling::linear, 1e9, {}};
  const DrawnComponent drawn = load(component, centered_gas_row());
  EXPECT_EQ(drawn.color.minimum, 1e9);
  EXPECT_GT(drawn.color.maximum, 1e9);
}

TEST(LoadFrameColor, RefusesALimitWithoutALogarithm) {
  Component component = gas();
  component.color = {"internal_energy", Scaling::log, 0.0, {}};
  EXPECT_THAT(refusal(scene_of({component}), centered_gas_row()), HasSubstr("color.min is 0"));
}

TEST(LoadFrameColor, OfOneValueForAllIsTheMiddleOfThePalette) {
  MemorySnapshot snapshot = centered_gas_row();
  snapshot.add(0, "temperature", std::vector<float>(5, 100));
  Component component = gas();
  component.color = {"temperature", Scaling::log, {}, {}};
  const DrawnComponent drawn = load(component, snapshot);
  EXPECT_NEAR(0.5 * (drawn.color.minimum + drawn.color.maximum), 2, 1e-6);
  EXPECT_GT(drawn.color.maximum, drawn.color.minimum);
  EXPECT_THAT(notes_of(component, snapshot), Contains(HasSubstr("the same for all")));
}

// To such numbers 1 adds nothing.
TEST(LoadFrameColor, OfOneLargeValueForAllIsTheMiddleOfThePalette) {
  MemorySnapshot snapshot = centered_gas_row();
  snapshot.add(0, "temperature", std::vector<float>(5, 3e20F));
  Component component = gas();
  component.color = {"temperature", Scaling::linear, {}, {}};
  const DrawnComponent drawn = load(component, snapshot);
  EXPECT_LT(drawn.color.minimum, 3e20);
  EXPECT_GT(drawn.color.maximum, 3.00001e20);
}

TEST(LoadFrameColor, KeepsARangeBeyondALargeLimit) {
  MemorySnapshot snapshot = centered_gas_row();
  snapshot.add(0, "temperature", std::vector<float>(5, 100));
  Component component = gas();
  component.color = {"temperature", Scaling::linear, 3e20, {}};
  EXPECT_GT(load(component, snapshot).color.maximum, 3.00001e20);
}

TEST(LoadFrameIntensity, HasARangeLikeTheColor) {
  Component component = gas();
  component.intensity = {"internal_energy", Scaling::log, 1, 1e4};
  const DrawnComponent drawn = load(component, centered_gas_row());
  EXPECT_EQ(drawn.intensity.maximum, 4);
}

MemorySnapshot grid_without_sizes() {
  MemorySnapshot snapshot;
  std::vector<float> position;
  for (int i = 0; i < 1000; ++i) {
    position.insert(position.end(), {static_cast<float>(i % 10), static_cast<float>(i / 10 % 10),
                                     static_cast<float>(i / 100)});
  }
  snapshot.add(0, "position", position, 3);
  snapshot.set_table_mass(0, 2);
  return snapshot;
}

TEST(LoadFrameSize, IsFoundFromNeighborsWhereTheFileHasNone) {
  const MemorySnapshot snapshot = grid_without_sizes();
  const DrawnComponent drawn = load(gas(), snapshot);
  // The 64th neighbour on a unit grid: beyond the 56 within sqrt(5) lies sqrt(6).
  // Point (5, 5, 5) is particle 555.
  EXPECT_NEAR(drawn.particles.smoothing_length[555], std::sqrt(6.0f), 1e-6);
  EXPECT_THAT(notes_of(gas(), snapshot), Contains(HasSubstr("64")));
}

TEST(LoadFrameSize, LooksAcrossTheFacesOfAPeriodicBox) {
  MemorySnapshot snapshot = grid_without_sizes();
  snapshot.set_box_size(10);
  EXPECT_NEAR(load(gas(), snapshot).particles.smoothing_length[0], std::sqrt(6.0f), 1e-6);
}

TEST(LoadFrameSize, DoesNotTrustABoxThatParticlesLieOutsideOf) {
  MemorySnapshot snapshot = grid_without_sizes();
  snapshot.set_box_size(5);
  EXPECT_GT(load(gas(), snapshot).particles.smoothing_length[0], 2.5f);
}

TEST(LoadFrameSize, FollowsFromDensityAndMassWhereBothAreKnown) {
  MemorySnapshot snapshot = grid_without_sizes();
  snapshot.add(0, "density", std::vector<float>(1000, 4));
  const DrawnComponent drawn = load(gas(), snapshot);
  // The sphere that holds 64 particles: 4 pi / 3 h^3 rho = 64 m.
  const double expected = std::cbrt(64 * 2 / (4 * 4 * 3.14159265358979 / 3));
  EXPECT_NEAR(drawn.particles.smoothing_length[7], expected, 1e-6);
}

TEST(LoadFrameSize, IsFoundFromNeighborsWhereADensityIsMissing) {
  MemorySnapshot snapshot = grid_without_sizes();
  std::vector<float> density(1000, 4);
  density[3] = 0;  // as in initial conditions that were never evolved
  snapshot.add(0, "density", density);
  EXPECT_NEAR(load(gas(), snapshot).particles.smoothing_length[555], std::sqrt(6.0f), 1e-6);
  EXPECT_THAT(notes_of(gas(), snapshot), Contains(HasSubstr("some of its densities")));
}

TEST(LoadFrameSize, FixedReplacesTheField) {
  Component component = gas();
  component.size_fixed = 0.75;
  const MemorySnapshot snapshot = centered_gas_row();
  EXPECT_EQ(load(component, snapshot).particles.smoothing_length[3], 0.75f);
  EXPECT_THAT(snapshot.fields_read(), Not(Contains("smoothing_length")));
}

TEST(LoadFrameDensity, IsEstimatedFromSizesWhereTheFileHasNone) {
  Component component = gas();
  component.color.field = "density";
  const DrawnComponent drawn = load(component, centered_gas_row());
  // 64 of its own mass in a sphere of radius 1.
  EXPECT_NEAR(drawn.particles.color[1], 64 * 2 / (4 * 3.14159265358979 / 3), 1e-5);
}

TEST(LoadFrameReference, MakesThePictureTheSameInAnyUnit) {
  const DrawnComponent grams = load(gas(), centered_gas_row());
  MemorySnapshot heavy = centered_gas_row();
  MemorySnapshot snapshot;
  snapshot.add(0, "position", values(heavy.read(0, "position"), 15), 3);
  snapshot.add(0, "smoothing_length", std::vector<float>(5, 1));
  snapshot.add(0, "mass", {1024, 2048, 3072, 4096, 5120});
  const DrawnComponent other = load(gas(), snapshot);
  EXPECT_NEAR(other.reference_column / grams.reference_column, 1024, 1e-9);
}

TEST(LoadFrameReference, IsTheScenesWhereItGivesOne) {
  Component component = gas();
  component.reference_column = 3.5;
  EXPECT_EQ(load(component, centered_gas_row()).reference_column, 3.5);
}

TEST(LoadFrameReference, SaysWhenTheCameraSeesNothing) {
  Scene scene = scene_of({gas()});
  scene.camera->look_at = {{0, -40, 0}};
  std::vector<std::string> notes;
  load_frame(scene, centered_gas_row(), notes);
  EXPECT_THAT(notes, ElementsAre(HasSubstr("sees none of its particles")));
}

TEST(LoadFrameReference, SaysWhenNoParticleHasAWeight) {
  MemorySnapshot row = centered_gas_row();
  row.add(0, "mass", std::vector<float>(5, 0));
  EXPECT_THAT(notes_of(gas(), row), ElementsAre(HasSubstr("all its particles have the weight 0")));
}

TEST(LoadFrame, HasNothingToSayWhenNothingIsOdd) {
  EXPECT_THAT(notes_of(gas(), centered_gas_row()), IsEmpty());
}

TEST(LoadFrame, ChoosesACameraWhereTheSceneHasNone) {
  Scene scene = scene_of({gas()});
  scene.camera.reset();
  EXPECT_GT(load(scene, centered_gas_row()).camera.look_at_distance, 1);
}

}  // namespace
}  // namespace splotchcl::test
