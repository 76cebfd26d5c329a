// Places that the data say: of pictures and maps.
#include "map/gas.h"
#include "map/place.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Two of halo 7 across a face of a box of side 10, and a denser one of halo 3.
MemorySnapshot haloes() {
  Gas gas;
  gas.add({{9.5, 5, 5}}, 0.5F, 1, 100);
  gas.add({{0.5, 5, 5}}, 0.5F, 3, 100);
  gas.add({{3, 2, 1}}, 0.5F, 2, 100, {{0, 0, 0}}, 9);
  MemorySnapshot snapshot = gas.snapshot();
  snapshot.add(0, "halo_id", {7, 7, 3});
  return snapshot;
}

Vec3 place(const std::string& words, const MemorySnapshot& snapshot) {
  std::vector<std::string> notes;
  return find_named_place(words, map_scene(), snapshot, "center", notes);
}

void expect_near(const Vec3& found, const Vec3& expected) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(found.a[axis], expected.a[axis], 1e-5) << "axis " << axis;
}

TEST(NamedPlace, IsTheCenterOfAHaloAcrossAFace) {
  MemorySnapshot snapshot = haloes();
  snapshot.set_box_size(BoxSides(10));
  expect_near(place("halo=7", snapshot), {{0.25, 5, 5}});
  expect_near(place("halo=3", snapshot), {{3, 2, 1}});
}

TEST(NamedPlace, IsTheDensestParticleOrTheCenterOfMass) {
  expect_near(place("densest", haloes()), {{3, 2, 1}});
  expect_near(place("mass", haloes()), {{(9.5 + 1.5 + 6) / 6, (20 + 4) / 6.0, (20 + 2) / 6.0}});
}

TEST(NamedPlace, NeedsParticlesAndWordsThatAreKnown) {
  EXPECT_THROW(place("halo=5", haloes()), UsageError);
  for (const char* words : {"halo=", "halo=-1", "halo=1.5", "halo=3x", "middle", ""}) {
    try {
      place(words, haloes());
      ADD_FAILURE() << words;
    } catch (const UsageError& error) {
      EXPECT_THAT(error.what(), HasSubstr("center: found")) << words;
    }
  }
}

TEST(NamedPlace, IsReadFromThreeLengthsInTheUnitOfTheLast) {
  Scene scene = map_scene();
  scene.map.length_unit = "kpc";
  const MemorySnapshot snapshot = haloes();
  expect_near(read_place("1,2,3", scene, snapshot, "center"), {{1, 2, 3}});
  expect_near(read_place("1, 2, 3Mpc", scene, snapshot, "center"), {{1000, 2000, 3000}});
  expect_near(read_place("1kpc,2,3Mpc", scene, snapshot, "center"), {{1, 2000, 3000}});
  EXPECT_THROW(read_place("1,2", scene, snapshot, "center"), UsageError);
  EXPECT_THROW(read_place("1,2,3K", scene, snapshot, "center"), UsageError);
}

}  // namespace
}  // namespace splotchcl::test
