// Several kinds of matter in one ordered frame, from scene to picture.
#include "device/pictures.h"
#include "load/particles.h"
#include "splotchcl/plan.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Clumps of a kind of matter in a box of side 100 around the origin.
void add_clumps(MemorySnapshot& snapshot, int type, int count, double h, std::uint64_t seed) {
  Random random(seed);
  std::vector<float> position, velocity, size, mass, energy, density, color;
  Vec3 clump = {{0, 0, 0}};
  for (int i = 0; i < count; ++i) {
    if (i % 50 == 0) {
      for (double& x : clump.a)
        x = random.uniform(-50, 50);
    }
    const double spread = random.logarithmic(0.5, 30);
    for (const double center : clump.a) {
      position.push_back(static_cast<float>(center + spread * random.uniform(-1, 1)));
      velocity.push_back(static_cast<float>(random.uniform(-200, 200)));
      color.push_back(static_cast<float>(random.uniform(0, 1.5)));
    }
    size.push_back(static_cast<float>(h * random.logarithmic(0.2, 4)));
    mass.push_back(static_cast<float>(random.logarithmic(0.1, 10)));
    energy.push_back(static_cast<float>(random.logarithmic(1e2, 1e6)));
    density.push_back(static_cast<float>(random.logarithmic(1e-3, 1e3)));
  }
  snapshot.add(type, "position", position, 3);
  snapshot.add(type, "velocity", velocity, 3);
  snapshot.add(type, "smoothing_length", size);
  snapshot.add(type, "mass", mass);
  if (type == 0) snapshot.add(type, "internal_energy", energy);
  if (type == 0) snapshot.add(type, "density", density);
  if (type == 4) snapshot.add(type, "Color", color, 3);
}

MemorySnapshot cluster() {
  MemorySnapshot snapshot;
  add_clumps(snapshot, 0, 2000, 6, 1);
  add_clumps(snapshot, 1, 1500, 10, 2);
  add_clumps(snapshot, 4, 800, 1, 3);
  return snapshot;
}

Component named(const std::string& name, int type) {
  Component component;
  component.name = name;
  component.types = {type};
  return component;
}

Scene cluster_scene() {
  Component diffuse = named("diffuse gas", 0);
  diffuse.select.where = {"density < 1"};
  diffuse.color = {"internal_energy", Scaling::log, {}, {}};
  diffuse.absorption_palette = "ice";
  Component bound = named("bound gas", 0);
  bound.exclude = diffuse.select;
  bound.color = {"density", Scaling::log, {}, {}};
  bound.color.percentiles = {5, 100};
  bound.palette = "dust";
  bound.absorption = {Absorption::Kind::factor, 2};
  Component dark = named("dark matter", 1);
  dark.color = {"speed", Scaling::asinh, {}, {}};
  dark.palette = "halo";
  dark.brightness = 0.3;
  dark.absorption.kind = Absorption::Kind::none;
  Component galaxies = named("galaxies", 4);
  galaxies.select.sphere_center = Vec3{{0, 0, 0}};
  galaxies.select.sphere_radius = 60;
  galaxies.color_vector = "Color";
  galaxies.absorption.kind = Absorption::Kind::none;
  Component free_stars = named("free stars", 4);
  free_stars.exclude = galaxies.select;
  free_stars.palette = "white";
  free_stars.size_fixed = 0.8;
  free_stars.absorption = {Absorption::Kind::gray, 0.3};
  Scene scene = scene_of({diffuse, bound, dark, galaxies, free_stars});
  scene.image.width = 160;
  scene.image.height = 120;
  scene.camera->position = {{20, -140, 60}};
  scene.image.background = {0.02, 0.01, 0.05};
  return scene;
}

class OrderedComponents : public PictureTest, public ::testing::WithParamInterface<CompositeShape> {
 protected:
  void expect_within_tolerance(const Scene& scene) {
    const MemorySnapshot snapshot = cluster();
    const Frame frame = load(scene, snapshot);
    ASSERT_EQ(choose_light(frame), LightPlan::ordered);
    for (const DrawnComponent& component : frame.components) {
      EXPECT_GT(component.particles.count, 100u) << component.name;
    }
    const ReferenceImage exact = reference::render(frame);
    EXPECT_GT(largest_value(exact), 0.5);
    EXPECT_LE(largest_error(draw(frame, GetParam()), exact), frame.tolerance);
  }
};

TEST_P(OrderedComponents, OfGasDarkMatterAndStarsAgreeWithTheOracle) {
  expect_within_tolerance(cluster_scene());
}

TEST_P(OrderedComponents, AgreeWhereAFieldDecidesTheOrder) {
  Scene scene = cluster_scene();
  scene.sort.by = SortOrder::By::field;
  scene.sort.field = "radius";
  scene.sort.descending = true;
  expect_within_tolerance(scene);
}

TEST_P(OrderedComponents, AgreeWithOneThatIsPlaced) {
  Scene scene = cluster_scene();
  Component placed = scene.components[1];
  placed.name = "placed";
  placed.placement.origin = Vec3{{10, -30, 5}};
  placed.placement.axis = {{1, 1, 0}};
  placed.placement.angle_degrees = 75;
  placed.placement.scale = 0.3;
  scene.components.push_back(placed);
  expect_within_tolerance(scene);
}

// A galaxy of a millionth of the box in the middle of all the rest.
TEST_P(OrderedComponents, AgreeFromFarOutsideToInsideAPlantedGalaxy) {
  constexpr double scale = 1e-6;
  const Vec3 place = {{12.3456789, -7.654321, 3.1415926}};
  Scene scene = cluster_scene();
  scene.image.width = 96;
  scene.image.height = 72;
  for (const int original : {1, 3}) {
    Component planted = scene.components[static_cast<std::size_t>(original)];
    planted.name += ", planted";
    planted.placement.origin = place;
    planted.placement.axis = {{1, 2, 3}};
    planted.placement.angle_degrees = 50;
    planted.placement.scale = scale;
    scene.components.push_back(planted);
  }
  for (const double distance : {200.0, 3.0, 1e-2, 2e-4, 3e-5}) {
    scene.camera->position = Vec3(place + distance * Vec3{{0.3, -0.9, 0.2}});
    // From afar all of the galaxy is one grain, which must not lie on the edge of a pixel,
    // where the last bit of its place decides which pixel has the light.
    scene.camera->look_at = Vec3(place + distance * Vec3{{0.031, 0.01, 0.047}});
    SCOPED_TRACE(distance);
    expect_within_tolerance(scene);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, OrderedComponents,
                         ::testing::Values(CompositeShape::rows, CompositeShape::groups),
                         [](const auto& info) {
                           return info.param == CompositeShape::rows ? "rows" : "groups";
                         });

// What a selection divides, drawn as two components of the same look, is the whole.
TEST(DividedComponents, DrawWhatTheWholeDraws) {
  const MemorySnapshot snapshot = cluster();
  Component gas = named("gas", 0);
  gas.color = {"density", Scaling::log, 1e-3, 1e3};
  gas.reference_column = 0.5;
  gas.palette = "dust";
  gas.absorption = {Absorption::Kind::factor, 2};
  gas.absorption_palette = "viridis";
  Component first = gas, second = gas;
  first.name = "first";
  first.select.where = {"internal_energy > 1e4"};
  second.name = "second";
  second.exclude = first.select;
  Scene whole = cluster_scene();
  Scene divided = whole;
  whole.components = {gas};
  divided.components = {first, second};
  const ReferenceImage a = reference::render(load(whole, snapshot));
  const ReferenceImage b = reference::render(load(divided, snapshot));
  double largest = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    largest = std::max(largest, std::abs(a.pixels[i] - b.pixels[i]));
  EXPECT_LT(largest, 1e-12);
}

}  // namespace
}  // namespace splotchcl::test
