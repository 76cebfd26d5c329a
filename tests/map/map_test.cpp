#include "splotchcl/map.h"

#include "map/gas.h"
#include "snapshot/derived_snapshots.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// The column of a Gaussian over a pixel, from the definition: two differences of erf.
double pixel_part(double x, double y, double sigma, double pixel_x, double pixel_y) {
  const auto along = [sigma](double from) {
    return 0.5 * (std::erf((from + 1) / sigma) - std::erf(from / sigma));
  };
  return along(pixel_x - x) * along(pixel_y - y);
}

// Pixel (x, y) of map_scene()'s map from the top left, in lengths to the right and upwards.
double left_of(int x) {
  return x - 32;
}
double bottom_of(int y) {
  return 23 - y;
}

struct Sums {
  double weight = 0, value = 0, square = 0;
};

// All particles, in double precision.
template <class Weight, class Value>
Sums brute_force(const Gas& gas, int x, int y, Weight weight, Value value) {
  Sums sums;
  for (std::size_t i = 0; i < gas.h.size(); ++i) {
    const double sigma = sigma_of_h * static_cast<double>(gas.h[i]);
    const double part =
        pixel_part(static_cast<double>(gas.position[3 * i]),
                   static_cast<double>(gas.position[3 * i + 1]), sigma, left_of(x), bottom_of(y));
    const double w = part * weight(i, sigma), v = value(i);
    sums.weight += w;
    sums.value += w * v;
    sums.square += w * v * v;
  }
  return sums;
}

constexpr std::pair<int, int> some_pixels[] = {{32, 24}, {5, 7}, {50, 40}, {0, 0}, {63, 47}};

TEST(Map, HasTheSurfaceDensityOfAllParticles) {
  const Gas gas = random_gas(300, 30, 0.3F, 20);
  const Map map = map_of(map_scene(), gas.snapshot());
  EXPECT_EQ(map.unit, "code_mass/code_length^2");
  for (const auto& [x, y] : some_pixels) {
    const double expected =
        brute_force(
            gas, x, y, [&](std::size_t i, double) { return static_cast<double>(gas.mass[i]); },
            [](std::size_t) { return 1.0; })
            .weight;
    EXPECT_NEAR(static_cast<double>(at(map, x, y)), expected, 1e-6 * expected + 1e-9);
  }
}

// Of seven stars every tenth is one.
TEST(Map, OfAPartOfTheParticlesCountsAllOfEachType) {
  const auto whole = std::make_shared<test::MemorySnapshot>(random_gas(300, 5, 1, 2).snapshot());
  const Gas stars = random_gas(7, 5, 1, 2, 2);
  whole->add(4, "position", stars.position, 3);
  whole->add(4, "smoothing_length", stars.h);
  ReadSettings read;
  read.every = 10;
  const SubsetSnapshot part(whole, read);
  Scene scene = map_scene();
  scene.map.quantity = "counts";
  scene.components.front().types = {4};
  EXPECT_NEAR(total_of(map_of(scene, part).values), 7, 1e-4);
  scene.components.front().types = {0, 4};
  EXPECT_NEAR(total_of(map_of(scene, part).values), 307, 1e-3);
}

TEST(Map, DoesNotDependOnTheSizeOfAPixelButForItsArea) {
  Gas gas;
  gas.add({{0, 0, 0}}, 40, 5, 100);
  Scene scene = map_scene();
  const double coarse = static_cast<double>(at(map_of(scene, gas.snapshot()), 32, 24));
  scene.image.width = 640;
  scene.image.height = 480;
  const double fine = static_cast<double>(at(map_of(scene, gas.snapshot()), 320, 240));
  EXPECT_NEAR(coarse / fine, 1, 3e-3);
}

TEST(Map, HasTheWeightedMeanAlongTheLine) {
  const Gas gas = random_gas(300, 30, 1, 20);
  Scene scene = map_scene();
  scene.map.quantity = "temperature";
  scene.map.floor = 1e-9;
  for (const std::string weight : {"mass", "volume", "constant"}) {
    scene.map.weight = weight;
    const Map map = map_of(scene, gas.snapshot());
    for (const auto& [x, y] : some_pixels) {
      const Sums sums = brute_force(
          gas, x, y,
          [&](std::size_t i, double) {
            if (weight == "constant") return 1.0;
            return static_cast<double>(weight == "volume" ? gas.mass[i] / gas.density[i]
                                                          : gas.mass[i]);
          },
          [&](std::size_t i) { return static_cast<double>(gas.temperature[i]); });
      EXPECT_NEAR(static_cast<double>(at(map, x, y)) / (sums.value / sums.weight), 1, 3e-6);
    }
  }
}

TEST(Map, SaysWhyAllValuesAreInfinite) {
  Gas gas = one_particle({{0, 0, 0}}, 10);
  gas.mass[0] = std::numeric_limits<float>::infinity();
  EXPECT_THAT([&] { map_of(map_scene(), gas.snapshot()); },
              ThrowsMessage<DataError>(HasSubstr("numbers beyond single precision")));
}

TEST(Map, SaysWhatCanBeHadWithoutMasses) {
  test::MemorySnapshot snapshot;
  snapshot.add(0, "position", {0, 0, 0}, 3);
  snapshot.add(0, "smoothing_length", {10});
  snapshot.add(0, "temperature", {5});
  const auto refusal_of = [&snapshot](const Scene& scene) {
    try {
      map_of(scene, snapshot);
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  Scene scene = map_scene();
  EXPECT_THAT(refusal_of(scene), HasSubstr("set map.quantity to \"counts\""));
  scene.map.quantity = "temperature";
  EXPECT_THAT(refusal_of(scene), HasSubstr("set map.weight to \"constant\""));
  scene.map.weight = "constant";
  EXPECT_NEAR(static_cast<double>(at(map_of(scene, snapshot), 32, 24)), 5, 1e-5);
  scene.map.weight.clear();
  scene.map.statistic = MapStatistic::integral;
  EXPECT_THAT(refusal_of(scene), HasSubstr("set map.statistic to \"mean\""));
}

TEST(Map, HasTheMeanAndTheDispersionOfVelocitiesAlongTheLine) {
  const Gas gas = random_gas(300, 30, 2, 20);
  Scene scene = map_scene();
  scene.map.quantity = "line_of_sight_velocity";
  const Map mean = map_of(scene, gas.snapshot());
  scene.map.statistic = MapStatistic::dispersion;
  const Map dispersion = map_of(scene, gas.snapshot());
  for (const auto& [x, y] : some_pixels) {
    const Sums sums = brute_force(
        gas, x, y, [&](std::size_t i, double) { return static_cast<double>(gas.mass[i]); },
        // Seen from above: what moves downwards moves away.
        [&](std::size_t i) { return -static_cast<double>(gas.velocity[3 * i + 2]); });
    const double expected = sums.value / sums.weight;
    EXPECT_NEAR(static_cast<double>(at(mean, x, y)), expected, 1e-5);
    EXPECT_NEAR(static_cast<double>(at(dispersion, x, y)),
                std::sqrt(sums.square / sums.weight - expected * expected), 1e-5);
  }
}

TEST(Map, HasTheIntegralAlongTheLineAlsoOfNegativeValues) {
  const Gas gas = random_gas(300, 30, 1, 20);
  Scene scene = map_scene();
  scene.map.quantity = "velocity_x";
  scene.map.statistic = MapStatistic::integral;
  const Map map = map_of(scene, gas.snapshot());
  for (const auto& [x, y] : some_pixels) {
    const Sums sums = brute_force(
        gas, x, y,
        [&](std::size_t i, double) { return static_cast<double>(gas.mass[i] / gas.density[i]); },
        [&](std::size_t i) { return static_cast<double>(gas.velocity[3 * i]); });
    EXPECT_NEAR(static_cast<double>(at(map, x, y)), sums.value, 2e-6 * sums.weight);
  }
}

TEST(Map, HasTheValueInThePlaneWhereItIsASlice) {
  const Gas gas = random_gas(300, 30, 8, 30);
  Scene scene = map_scene();
  scene.map.slice = true;
  const Map density = map_of(scene, gas.snapshot());
  scene.map.quantity = "temperature";
  const Map temperature = map_of(scene, gas.snapshot());
  const auto in_plane = [&](std::size_t i, double sigma) {
    const double z = static_cast<double>(gas.position[3 * i + 2]);
    return std::exp(-z * z / (sigma * sigma)) / (std::sqrt(std::acos(-1.0)) * sigma);
  };
  for (const auto& [x, y] : some_pixels) {
    const double expected = brute_force(
                                gas, x, y,
                                [&](std::size_t i, double sigma) {
                                  return static_cast<double>(gas.mass[i]) * in_plane(i, sigma);
                                },
                                [](std::size_t) { return 1.0; })
                                .weight;
    EXPECT_NEAR(static_cast<double>(at(density, x, y)) / expected, 1, 3e-6);
    const Sums sums = brute_force(
        gas, x, y,
        [&](std::size_t i, double sigma) {
          return static_cast<double>(gas.mass[i] / gas.density[i]) * in_plane(i, sigma);
        },
        [&](std::size_t i) { return static_cast<double>(gas.temperature[i]); });
    EXPECT_NEAR(static_cast<double>(at(temperature, x, y)) / (sums.value / sums.weight), 1, 3e-6);
  }
}

TEST(Map, CountsEveryParticleInsideOnce) {
  Scene scene = map_scene();
  scene.map.quantity = "counts";
  EXPECT_NEAR(total_of(map_of(scene, random_gas(200, 20, 0.01F, 1).snapshot()).values), 200, 1e-3);
}

TEST(Map, MapsAConstantFieldToTheConstant) {
  Gas gas = random_gas(500, 30, 0.1F, 20);
  std::fill(gas.temperature.begin(), gas.temperature.end(), 1234.5F);
  Scene scene = map_scene();
  scene.map.quantity = "temperature";
  for (const float value : map_of(scene, gas.snapshot()).values) {
    if (!std::isnan(value)) {
      EXPECT_NEAR(static_cast<double>(value) / 1234.5, 1, 1e-6);
    }
  }
}

TEST(Map, MapsALinearFieldOnALatticeToItsPlane) {
  Gas gas;
  for (int x = -45; x <= 45; x += 2) {
    for (int y = -40; y <= 40; y += 2)
      gas.add({{double(x), double(y), 0}}, 10, 1, static_cast<float>(1000 + 3 * x + 5 * y));
  }
  Scene scene = map_scene();
  scene.map.quantity = "temperature";
  const Map map = map_of(scene, gas.snapshot());
  for (const auto& [x, y] :
       {std::make_pair(32, 24), std::make_pair(20, 30), std::make_pair(40, 12)})
    EXPECT_NEAR(static_cast<double>(at(map, x, y)),
                1000 + 3 * (left_of(x) + 0.5) + 5 * (bottom_of(y) + 0.5), 0.01);
}

TEST(Map, MapsALinearFieldOnALatticeToItsValuesInTheSlicesPlane) {
  Gas gas;
  for (int x = -24; x <= 24; x += 2) {
    for (int y = -24; y <= 24; y += 2) {
      for (int z = -24; z <= 24; z += 2)
        gas.add({{double(x), double(y), double(z)}}, 8, 1,
                static_cast<float>(1000 + 3 * x + 5 * y + 7 * z));
    }
  }
  Scene scene = map_scene();
  scene.map.quantity = "temperature";
  scene.map.slice = true;
  scene.map.center = Vec3{{0, 0, 4.5}};
  const Map map = map_of(scene, gas.snapshot());
  for (const auto& [x, y] : {std::make_pair(32, 24), std::make_pair(27, 20)}) {
    EXPECT_NEAR(static_cast<double>(at(map, x, y)),
                1000 + 3 * (left_of(x) + 0.5) + 5 * (bottom_of(y) + 0.5) + 7 * 4.5, 0.01);
  }
}

TEST(Map, HasNoMeanWhereThereIsTooLittleMatter) {
  Gas gas;
  gas.add({{-20.5, 0.5, 0}}, 1, 1, 1000);
  Scene scene = map_scene();
  scene.map.quantity = "temperature";
  const Map map = map_of(scene, gas.snapshot());
  EXPECT_NEAR(static_cast<double>(at(map, 11, 23)), 1000, 1e-3);
  EXPECT_TRUE(std::isnan(at(map, 50, 23)));
}

TEST(Map, HasMeansBetweenTheParticlesToo) {
  Gas gas;
  gas.add({{-299.5, 0, 0}}, 400, 1, 1000);
  gas.add({{300.5, 0, 0}}, 400, 1, 3000);
  Scene scene = map_scene();
  scene.map.quantity = "temperature";
  EXPECT_NEAR(static_cast<double>(at(map_of(scene, gas.snapshot()), 32, 24)), 2000, 1);
}

TEST(Map, LeavesOutAndCountsParticlesWithoutAValue) {
  Gas gas = random_gas(10, 20, 1, 4);
  gas.temperature[3] = std::nanf("");
  gas.h[5] = 0;
  Scene scene = map_scene();
  scene.map.quantity = "temperature";
  std::vector<std::string> notes;
  const Map map = map_of(scene, gas.snapshot(), &notes);
  EXPECT_EQ(map.bad_particles, 2U);
  EXPECT_THAT(notes, Contains(HasSubstr("2 particles")));
}

TEST(Map, CountsAParticleWithoutAValueOnceWhateverItsImages) {
  Gas gas = one_particle({{0, 0, 0}}, 1);
  gas.add({{8, 0, 0}}, 1, 1, std::nanf(""));
  auto snapshot = gas.snapshot();
  snapshot.set_box_size(16);
  Scene scene = map_scene();
  scene.map.quantity = "temperature";
  scene.map.periodic = true;
  const Map map = map_of(scene, snapshot);
  EXPECT_GT(map.images, 4U);
  EXPECT_EQ(map.bad_particles, 1U);
}

TEST(Map, IsEmptyWhereNoParticleReachesIt) {
  Scene scene = map_scene();
  scene.map.center = Vec3{{1000, 0, 0}};
  const Map map = map_of(scene, random_gas(20, 20, 1, 4).snapshot());
  EXPECT_EQ(map.values, std::vector<float>(64 * 48, 0.0F));
}

TEST(Map, RefusesWeightsBelowZero) {
  Scene scene = map_scene();
  scene.map.quantity = "temperature";
  scene.map.weight = "velocity_x";
  EXPECT_THROW(map_of(scene, random_gas(20, 20, 1, 4).snapshot()), DataError);
}

TEST(Map, RefusesSettingsThatContradictEachOther) {
  const auto snapshot = random_gas(20, 20, 1, 4).snapshot();
  Scene scene = map_scene();
  scene.map.statistic = MapStatistic::integral;
  EXPECT_THROW(map_of(scene, snapshot), UsageError);
  scene.map.quantity = "temperature";
  scene.map.slice = true;
  EXPECT_THROW(map_of(scene, snapshot), UsageError);
  scene = map_scene();
  scene.map.quantity = "counts";
  scene.map.slice = true;
  EXPECT_THROW(map_of(scene, snapshot), UsageError);
  scene = map_scene();
  scene.map.weight = "volume";
  EXPECT_THROW(map_of(scene, snapshot), UsageError);
  scene = map_scene();
  scene.map.sky = {10, 20};
  EXPECT_THROW(map_of(scene, snapshot), UsageError);
}

TEST(Map, TellsHowManyParticlesAPixelIsMadeOf) {
  Gas gas;
  for (int i = 0; i < 7; ++i)
    gas.add({{-19.5, 0.5, 0}}, 0.01F, 2, 100);
  gas.add({{-18.5, 0.5, 0}}, 0.01F, 200, 100);  // in the next pixel
  for (int i = 0; i < 5; ++i)
    gas.add({{15.5, 0.5, 0}}, 30, 2, 100);
  Scene scene = map_scene();
  scene.map.noise = true;
  const Map map = map_of(scene, gas.snapshot());
  const auto effective = [&map](int x, int y) {
    return static_cast<double>(
        map.effective_particles[static_cast<std::size_t>(y * map.width + x)]);
  };
  EXPECT_NEAR(effective(12, 23), 7, 0.05);
  EXPECT_NEAR(effective(13, 23), 1, 0.01);
  EXPECT_NEAR(effective(47, 23), 5, 0.05);
}

TEST(Map, DoesNotTellOfParticlesWhereThereIsTooLittleMatter) {
  Gas gas;
  gas.add({{-19.5, 0.5, 0}}, 0.5F, 2, 100);
  Scene scene = map_scene();
  scene.map.noise = true;
  const Map map = map_of(scene, gas.snapshot());
  EXPECT_TRUE(std::isnan(map.effective_particles[23 * 64 + 60]));
}

TEST(Map, NeverTellsOfMoreParticlesThanThereAre) {
  const Gas gas = random_gas(40, 25, 0.05F, 8);
  Scene scene = map_scene();
  scene.map.noise = true;
  for (const float effective : map_of(scene, gas.snapshot()).effective_particles) {
    if (!std::isnan(effective)) {
      ASSERT_LE(effective, 40.0F);
    }
  }
}

TEST(Map, OfNothingButBadParticlesIsRefused) {
  Gas gas = random_gas(20, 10, 1, 2);
  std::fill(gas.mass.begin(), gas.mass.end(), std::nanf(""));
  EXPECT_THAT([&] { map_of(map_scene(), gas.snapshot()); },
              ThrowsMessage<DataError>(HasSubstr("none of its 20 particles can be mapped")));
}

TEST(Map, TellsOfParticlesWhoseWeightLiesBelowZero) {
  Gas gas = random_gas(20, 10, 1, 2);
  gas.mass[3] = -1;
  std::vector<std::string> notes;
  map_of(map_scene(), gas.snapshot(), &notes);
  EXPECT_THAT(notes, Contains(HasSubstr("or the weight below 0")));
}

}  // namespace
}  // namespace splotchcl::test
