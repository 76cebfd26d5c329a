// Shapes of haloes and what lies within them.
#include "generate/halo_profile.h"
#include "generate/web.h"
#include "splotchcl/generate.h"
#include "testing.h"

namespace splotchcl {
namespace {

std::vector<Vec3> gas_of(const HaloInterior& interior, int count) {
  Random random(4);
  std::vector<Vec3> places;
  for (int i = 0; i < count; ++i)
    places.push_back(interior.gas(random.uniform(), random).place);
  return places;
}

// Matter flows towards a filament along x, least along it.
HaloShape along_x() {
  return shape_of_halo({Vec3{{-0.2, 0, 0}}, Vec3{{0, -0.7, 0}}, Vec3{{0, 0, -1}}}, 1);
}

TEST(HaloShape, IsLongestWhereMatterFallsInLast) {
  Random random(1);
  const HaloInterior interior(along_x(), 0, random);
  Vec3 square = {{0, 0, 0}};
  for (const Vec3& place : gas_of(interior, 20000)) {
    for (int axis = 0; axis < 3; ++axis)
      square.a[axis] += place.a[axis] * place.a[axis];
  }
  EXPECT_GT(std::sqrt(square.a[0] / square.a[1]), 1.15);
  EXPECT_GT(std::sqrt(square.a[1] / square.a[2]), 1.05);
}

TEST(HaloShape, WithoutATideIsABall) {
  const HaloShape shape = shape_of_halo({Vec3{{-1, 0, 0}}, Vec3{{0, -1, 0}}, Vec3{{0, 0, -1}}}, 1);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j)
      EXPECT_EQ(shape.rows[i].a[j], i == j ? 1 : 0);
  }
}

// Pairs of particles closer than a thirtieth of the virial radius, outside of the middle.
int close_pairs(const std::vector<Vec3>& places) {
  int pairs = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (boost::qvm::mag(places[i]) < 0.3) continue;
    for (std::size_t j = 0; j < i; ++j)
      pairs += boost::qvm::mag(places[i] - places[j]) < 1.0 / 30 ? 1 : 0;
  }
  return pairs;
}

TEST(HaloInterior, HasSmallerHaloesInIt) {
  Random random(1);
  const HaloInterior few(HaloShape(), 50, random), many(HaloShape(), 50000, random);
  EXPECT_GT(close_pairs(gas_of(many, 4000)), 3 * close_pairs(gas_of(few, 4000)));
}

TEST(HaloInterior, GasOfSmallerHaloesIsCooler) {
  Random random(1);
  const HaloInterior interior(HaloShape(), 50000, random);
  int cool = 0;
  for (int i = 0; i < 10000; ++i)
    cool += interior.gas(random.uniform(), random).heat < 0.25 ? 1 : 0;
  // A sixth of the mass is in them; some of it, in the largest, is warmer.
  EXPECT_GT(cool, 800);
  EXPECT_LT(cool, 2500);
}

TEST(GenerateCluster, HasColdStreamsWithinHotGas) {
  const GeneratedParticles gas = generate_cluster({20000, 0, 1}).gas;
  int cold = 0, hot = 0;
  for (std::size_t i = 0; i < gas.count(); ++i) {
    const double radius = std::hypot(gas.position[3 * i], gas.position[3 * i + 1],
                                     static_cast<double>(gas.position[3 * i + 2]));
    if (radius > 1500) continue;
    cold += gas.internal_energy[i] < 2000 ? 1 : 0;  // below 1.5e5 K
    hot += gas.internal_energy[i] > 4e5F ? 1 : 0;   // above 3e7 K
  }
  EXPECT_GT(cold, 300);
  EXPECT_GT(hot, 10 * cold / 2);
}

// Some places move all of their way towards the web's ridges and some a third of it, and shorter
// waves part strands by some hundred kpc.
TEST(Web, FilamentsAreNoTubes) {
  Random random(1);
  const Web web(50000, random);
  std::vector<Vec3> places;
  for (int i = 0; i < 20000; ++i)
    places.push_back({{random.uniform(), random.uniform(), random.uniform()}});
  std::vector<double> parts;
  for (const Vec3& place : places)
    parts.push_back(web.sharpness(place));
  EXPECT_LT(*std::min_element(parts.begin(), parts.end()), 0.4);
  EXPECT_GT(*std::max_element(parts.begin(), parts.end()), 0.95);
  double square = 0;
  for (const Vec3& place : places) {
    const Vec3 by = web.strayed(place);
    square += boost::qvm::dot(by, by);
  }
  const double deviation = 50000 * std::sqrt(square / static_cast<double>(places.size()));
  EXPECT_GT(deviation, 100);
  EXPECT_LT(deviation, 1000);
}

}  // namespace
}  // namespace splotchcl
