// Maps by OpenCL, against those by the reference renderer and closed forms.
#include "map/gas.h"
#include "scene/constants.h"
#include "splotchcl/map.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

using ::testing::Ge;

class MapOnTheDevice : public testing::Test {
 protected:
  void SetUp() override {
    if (list_devices().empty()) GTEST_SKIP() << "no OpenCL device";
    renderer_ = std::make_unique<Renderer>();
  }
  Map map(const Scene& scene, const Snapshot& snapshot) {
    return map_on_device(*renderer_, scene, snapshot);
  }

 private:
  std::unique_ptr<Renderer> renderer_;
};

// What of the mass lies in the map, by the uncut kernels.
double mass_inside(const Gas& gas) {
  const auto part = [](double x, double half, double sigma) {
    return 0.5 * (std::erf((half - x) / sigma) + std::erf((half + x) / sigma));
  };
  double mass = 0;
  for (std::size_t i = 0; i < gas.h.size(); ++i) {
    const double sigma = sigma_of_h * static_cast<double>(gas.h[i]);
    mass += static_cast<double>(gas.mass[i]) *
            part(static_cast<double>(gas.position[3 * i]), 32, sigma) *
            part(static_cast<double>(gas.position[3 * i + 1]), 24, sigma);
  }
  return mass;
}

// From a thousandth of a pixel to a thousand pixels.
TEST_F(MapOnTheDevice, KeepsTheMassOfAllSizesAtToleranceZero) {
  const auto mass_in_map = [this](const Scene& scene, const Gas& gas) {
    return total_of(map(scene, gas.snapshot()).values);
  };
  for (const float h : {1e-3F, 1e-2F, 0.1F, 1.0F, 10.0F, 100.0F, 1e3F}) {
    const Gas gas = random_gas(100, 8, h, h);
    const double mass = mass_inside(gas);
    EXPECT_NEAR(mass_in_map(map_scene(), gas) / mass, 1, 1e-6) << h;
    Scene scene = map_scene();
    scene.tolerance = 1e-3;
    EXPECT_NEAR(mass_in_map(scene, gas) / mass, 1, 1e-3) << h;
  }
}

// Next to nothing of what makes values differ lies in the map, so that they have a large range.
TEST_F(MapOnTheDevice, KnowsDispersionsWhereWeightsReachTheFloorWhateverTheValues) {
  const auto h_of = [](double sigma) { return static_cast<float>(sigma / sigma_of_h); };
  const auto mass_of = [](double sigma) { return static_cast<float>(pi * sigma * sigma); };
  Gas gas;
  gas.add({{40, 0, 0}}, h_of(20), mass_of(20), 0.6F);
  gas.add({{70, -50, 0}}, h_of(7), mass_of(7), 0.1F);
  Scene scene = map_scene();
  scene.tolerance = 1e-4;
  Scene exact = scene;
  exact.tolerance = 0;
  const Map columns = map(exact, gas.snapshot());
  scene.map.quantity = "temperature";
  scene.map.statistic = MapStatistic::dispersion;
  const Map dispersions = map(scene, gas.snapshot());
  int known = 0;
  for (std::size_t i = 0; i < columns.values.size(); ++i) {
    const double of_floor = static_cast<double>(columns.values[i]) / dispersions.floor;
    if (std::abs(of_floor - 1) < 2 * scene.tolerance) continue;
    EXPECT_EQ(std::isnan(dispersions.values[i]), of_floor < 1) << i << " " << of_floor;
    known += of_floor >= 1;
  }
  EXPECT_GT(known, 1000);
  EXPECT_LT(known, 2500) << "some must lie below the floor";
}

// Few wide kernels on coarse grids, which ring around them.
TEST_F(MapOnTheDevice, HasNothingBelowZeroOfWhatIsAboveIt) {
  const Gas gas = random_gas(200, 4, 4, 8);
  Scene scene = map_scene();
  scene.image.width = 640;
  scene.image.height = 480;
  scene.tolerance = 1e-3;
  for (const char* const quantity : {"surface_density", "temperature"}) {
    scene.map.quantity = quantity;
    const bool is_field = scene.map.quantity == "temperature";
    scene.map.statistic = is_field ? MapStatistic::integral : MapStatistic::mean;
    EXPECT_THAT(map(scene, gas.snapshot()).values, Each(Ge(0.0F))) << quantity;
  }
}

TEST_F(MapOnTheDevice, HasIntegralsOfBothSigns) {
  Gas gas;
  gas.add({{-16, 0, 0}}, 3, 1, 100, {{2, 0, 0}});
  gas.add({{16, 0, 0}}, 3, 1, 100, {{-2, 0, 0}});
  Scene scene = map_scene();
  scene.map.quantity = "velocity_x";
  scene.map.statistic = MapStatistic::integral;
  const Map drawn = map(scene, gas.snapshot());
  EXPECT_GT(at(drawn, 16, 24), 0.01F);
  EXPECT_NEAR(at(drawn, 48, 24), -at(drawn, 15, 24), 1e-5F);
}

TEST_F(MapOnTheDevice, KeepsTheToleranceOfItsSums) {
  const auto snapshot = random_gas(2000, 30, 0.5F, 30).snapshot();
  Scene scene = map_scene();
  scene.tolerance = 1e-4;
  const Map drawn = map(scene, snapshot);
  const Map exact = map_of(scene, snapshot);
  for (std::size_t i = 0; i < exact.values.size(); ++i) {
    const auto expected = static_cast<double>(exact.values[i]);
    EXPECT_NEAR(static_cast<double>(drawn.values[i]), expected,
                1.01e-4 * std::max(expected, exact.floor));
  }
}

// Squares of many small weights are far below the square of their sum.
TEST_F(MapOnTheDevice, TellsOfManyParticlesInAPixelToo) {
  Gas gas;
  for (int i = 0; i < 1000; ++i)
    gas.add({{0.5, 0.5, 0}}, 15, 2, 100);
  Scene scene = map_scene();
  scene.tolerance = 1e-3;
  scene.map.noise = true;
  const Map drawn = map(scene, gas.snapshot());
  EXPECT_NEAR(static_cast<double>(drawn.effective_particles[23 * 64 + 32]), 1000, 10);
}

TEST_F(MapOnTheDevice, MapsAConstantFieldToTheConstantAtAnyTolerance) {
  Gas gas = random_gas(2000, 30, 1e-2F, 30);
  std::fill(gas.temperature.begin(), gas.temperature.end(), 1234.5F);
  Scene scene = map_scene();
  scene.map.quantity = "temperature";
  for (const double tolerance : {1e-2, 1e-3, 0.0}) {
    scene.tolerance = tolerance;
    const Map drawn = map(scene, gas.snapshot());
    for (const float value : drawn.values) {
      if (!std::isnan(value)) {
        ASSERT_NEAR(static_cast<double>(value) / 1234.5, 1, 1e-6) << tolerance;
      }
    }
  }
}

// docs/maps.md: tolerance (F + max(F, S / D)), to first order.
TEST_F(MapOnTheDevice, KeepsTheBoundOfItsMeans) {
  Gas gas = random_gas(2000, 20, 0.5F, 8);
  const auto snapshot = gas.snapshot();
  Scene scene = map_scene();
  scene.tolerance = 1e-3;
  const Map column = map_of(scene, snapshot);
  scene.map.quantity = "temperature";
  const Map drawn = map(scene, snapshot);
  const Map exact = map_of(scene, snapshot);
  std::nth_element(gas.temperature.begin(), gas.temperature.begin() + 1000, gas.temperature.end());
  const auto typical = static_cast<double>(gas.temperature[1000]);
  for (std::size_t i = 0; i < exact.values.size(); ++i) {
    const auto mean = static_cast<double>(exact.values[i]);
    const double floors = static_cast<double>(column.values[i]) / column.floor;
    // Near one floor the two may disagree on whether there is enough matter.
    if (std::isnan(mean) || floors < 1.01) continue;
    EXPECT_NEAR(static_cast<double>(drawn.values[i]), mean,
                1.01e-3 * (mean + std::max(mean, typical / floors)));
  }
}

}  // namespace
}  // namespace splotchcl::test
