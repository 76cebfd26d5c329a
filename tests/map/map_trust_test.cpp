// Nothing that is chosen for looks reaches a map's numbers, and no box that its particles
// contradict.
#include "map/gas.h"
#include "splotchcl/load.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Of 64 particles in a row, all of one smoothing length, as suggestions have it for even gas.
MemorySnapshot even_gas() {
  Gas gas;
  for (int i = 0; i < 512; ++i) {
    const Vec3 place = {{8.0 * (i % 8) + 4, 8.0 * (i / 8 % 8) + 4, 8.0 * (i / 64) + 4}};
    gas.add(place, 6, 1 + static_cast<float>(i % 3), 100);
  }
  MemorySnapshot snapshot = gas.snapshot();
  snapshot.set_box_size(64);
  return snapshot;
}

MemorySnapshot few_stars() {
  const Gas gas = test::random_gas(100, 20, 1, 2);
  MemorySnapshot snapshot;
  snapshot.add(4, "position", gas.position, 3);
  snapshot.add(4, "mass", gas.mass);
  return snapshot;
}

MemorySnapshot with_colors() {
  const Gas gas = test::random_gas(300, 20, 1, 2);
  MemorySnapshot snapshot = gas.snapshot();
  snapshot.add(0, "color", gas.position.empty() ? gas.position : std::vector<float>(900, 0.5F), 3);
  return snapshot;
}

MemorySnapshot gas_and_stars() {
  const Gas gas = test::random_gas(300, 30, 1, 4, 3);
  MemorySnapshot snapshot = gas.snapshot();
  snapshot.add(4, "position", test::random_gas(80, 10, 1, 2, 7).position, 3);
  snapshot.add(4, "mass", std::vector<float>(80, 2.0F));
  return snapshot;
}

TEST(MapTrust, NoSuggestionForPicturesChangesAMap) {
  for (const Look look : {Look::press, Look::classic, Look::paper}) {
    for (const auto& make : {even_gas, few_stars, with_colors, gas_and_stars}) {
      const MemorySnapshot snapshot = make();
      const Scene suggested = suggest_scene(snapshot, look);
      for (const Component& component : suggested.components) {
        Scene plain = map_scene();
        plain.components.front().types = component.types;
        Scene scene = suggested;
        scene.components = {component};
        scene.map = plain.map;
        scene.tolerance = plain.tolerance;
        scene.image.width = plain.image.width;
        scene.image.height = plain.image.height;
        EXPECT_EQ(map_of(scene, snapshot).values, map_of(plain, snapshot).values) << component.name;
      }
    }
  }
}

TEST(MapTrust, NothingThatAComponentHasForItsLooksChangesAMap) {
  const MemorySnapshot snapshot = even_gas();
  const Scene plain = map_scene();
  const Map expected = map_of(plain, snapshot);
  using Change = std::function<void(Scene&, Component&)>;
  const std::vector<std::pair<const char*, Change>> changes = {
      {"size factor", [](Scene&, Component& c) { c.size_factor = 0.25; }},
      {"brightness", [](Scene&, Component& c) { c.brightness = 7; }},
      {"absorption",
       [](Scene&, Component& c) {
         c.absorption = {Absorption::Kind::factor, 3};
       }},
      {"reference column", [](Scene&, Component& c) { c.reference_column = 5; }},
      {"weight", [](Scene&, Component& c) { c.weight = WeightModel::constant; }},
      {"palette", [](Scene&, Component& c) { c.palette = "magma"; }},
      {"color",
       [](Scene&, Component& c) {
         c.color = {"temperature", Scaling::log, 10, 20};
       }},
      {"intensity",
       [](Scene&, Component& c) {
         c.intensity = {"density", Scaling::log, 1, 2};
       }},
      {"exposure", [](Scene& s, Component&) { s.finish.exposure = 3; }},
      {"tone", [](Scene& s, Component&) { s.finish.tone = ToneCurve::filmic; }},
      {"gamma", [](Scene& s, Component&) { s.image.gamma = 2.2; }},
      {"background",
       [](Scene& s, Component&) {
         s.image.background = {{0.3F, 0.2F, 0.1F}};
       }},
  };
  for (const auto& [name, change] : changes) {
    Scene scene = plain;
    change(scene, scene.components.front());
    EXPECT_EQ(map_of(scene, snapshot).values, expected.values) << name;
  }
}

TEST(MapTrust, AFactorOfAPicturesSizesIsToldAndAMapsOwnCounts) {
  const MemorySnapshot snapshot = even_gas();
  Scene scene = map_scene();
  scene.components.front().size_factor = 0.25;
  std::vector<std::string> notes;
  map_of(scene, snapshot, &notes);
  EXPECT_THAT(notes, Contains(HasSubstr("size.factor 0.25 is for pictures")));

  Scene wider = map_scene();
  wider.map.size_factor = 2;
  Gas gas = one_particle({{0, 0, 0}}, 8);
  EXPECT_EQ(map_of(wider, one_particle({{0, 0, 0}}, 4).snapshot()).values,
            map_of(map_scene(), gas.snapshot()).values);
}

Gas galaxy_without_a_box() {
  return test::random_gas(500, 25, 0.5F, 2);
}

TEST(MapTrust, ABoxThatParticlesReachBeyondIsNotUsedAndANoteSaysSo) {
  const Gas gas = galaxy_without_a_box();
  Scene scene = map_scene();
  const Map expected = map_of(scene, gas.snapshot());
  for (const double box : {1.0, 20.0, 49.0}) {
    MemorySnapshot snapshot = gas.snapshot();
    snapshot.set_box_size(box);
    std::vector<std::string> notes;
    EXPECT_EQ(map_of(scene, snapshot, &notes).values, expected.values) << box;
    EXPECT_THAT(notes, Contains(HasSubstr("in the header is not used"))) << box;
  }
}

TEST(MapTrust, OtherTypesOfParticlesContradictABoxToo) {
  Scene scene = map_scene();
  scene.components.front().types = {4};
  MemorySnapshot snapshot = galaxy_without_a_box().snapshot();
  const Gas stars = test::random_gas(100, 0.4, 0.1F, 0.2F);
  snapshot.add(4, "position", stars.position, 3);
  snapshot.add(4, "smoothing_length", stars.h);
  snapshot.add(4, "mass", stars.mass);
  const double mass = std::accumulate(stars.mass.begin(), stars.mass.end(), 0.0);
  snapshot.set_box_size(1);
  EXPECT_NEAR(sum(map_of(scene, snapshot)) / mass, 1, 1e-5);
}

TEST(MapTrust, ABoxThatTheUserNamesIsUsed) {
  const Gas gas = galaxy_without_a_box();
  const double mass = std::accumulate(gas.mass.begin(), gas.mass.end(), 0.0);
  Scene scene = map_scene();
  scene.image.height = 64;
  scene.map.periodic = true;
  MemorySnapshot snapshot = gas.snapshot();
  snapshot.set_box_size(32);
  std::vector<std::string> notes;
  EXPECT_NEAR(sum(map_of(scene, snapshot, &notes)) / mass, 4, 1e-5);
  EXPECT_THAT(notes, Each(Not(HasSubstr("is not used"))));
  scene.map.periodic.reset();
  scene.periodic.box = 32;
  EXPECT_NEAR(sum(map_of(scene, gas.snapshot())) / mass, 4, 1e-5);
}

// Single precision has rounded the far face's neighbors onto it.
TEST(MapTrust, ABoxWithParticlesOnBothFacesIsPeriodic) {
  Gas gas = one_particle({{0, 10, 10}}, 4);
  gas.add({{0.1F, 20, 20}}, 4, 1, 100);
  gas.add({{static_cast<double>(1e-6F + 64.0F), 30, 30}}, 4, 1, 100);
  MemorySnapshot snapshot = gas.snapshot();
  snapshot.set_box_size(64);
  Scene scene = map_scene();
  scene.image.height = 64;
  scene.map.center = Vec3{{32, 32, 32}};
  EXPECT_NEAR(sum(map_of(scene, snapshot)), 3, 1e-5);
}

TEST(MapTrust, ABoxOfThreeSidesIsPeriodicAlongEach) {
  Gas gas;
  for (int i = 0; i < 128; ++i)
    gas.add({{i % 32 + 0.5, i / 32 + 0.5, 0.5}}, 3, 1, 100);
  MemorySnapshot snapshot = gas.snapshot();
  snapshot.set_box_size(BoxSides(Vec3{{32, 4, 1}}));
  Scene scene = map_scene();
  scene.image.width = 64;
  scene.image.height = 8;
  scene.map.center.reset();
  scene.map.width.reset();
  const Map map = map_of(scene, snapshot);
  EXPECT_NEAR(map.pixel, 0.5, 1e-12);
  EXPECT_EQ(map.center.a[0], 16);
  EXPECT_EQ(map.center.a[1], 2);
  EXPECT_NEAR(sum(map) * map.pixel * map.pixel, 128, 1e-3);
  // Every line of sight shows the same, the faces' neighbors too.
  for (const float value : map.values)
    EXPECT_NEAR(value, 1, 0.1);
  scene.map.view = MapView::xz;
  scene.image.height = 2;
  const Map from_the_side = map_of(scene, snapshot);
  EXPECT_NEAR(sum(from_the_side) * from_the_side.pixel * from_the_side.pixel, 128, 1e-3);
}

TEST(MapTrust, OfParticlesWithoutAnyWeightSaysWhyItIsEmpty) {
  std::vector<std::string> notes;
  EXPECT_EQ(sum(map_of(map_scene(), one_particle({{0, 0, 0}}, 4, 0).snapshot(), &notes)), 0);
  EXPECT_THAT(notes, ElementsAre(HasSubstr("all particles have the weight 0")));
  notes.clear();
  map_of(map_scene(), one_particle({{0, 0, 0}}, 4, 1e-30F).snapshot(), &notes);
  EXPECT_THAT(notes, Each(Not(HasSubstr("the weight 0"))));
}

TEST(MapTrust, APartCutOutOfABoxFillsItsMap) {
  Gas gas = test::random_gas(200, 4, 0.5F, 1);
  for (float& x : gas.position)
    x += 700;
  MemorySnapshot snapshot = gas.snapshot();
  snapshot.set_box_size(1000);
  Scene scene = map_scene();
  scene.map.center.reset();
  scene.map.width.reset();
  const Map map = map_of(scene, snapshot);
  EXPECT_NEAR(map.center.a[0], 700, 1);
  EXPECT_NEAR(map.pixel * map.width, 8 * 64.0 / 48, 1);
}

}  // namespace
}  // namespace splotchcl::test
