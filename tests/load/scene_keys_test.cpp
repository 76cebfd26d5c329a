// The keys of components' particles in scene files.
#include "load/particles.h"
#include "splotchcl/scene_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

Component parse(const std::string& lines) {
  return parse_scene("snapshot = \"s\"\n[[component]]\n" + lines, "scene.toml").components.at(0);
}

TEST(ParticleKeys, SelectByConditionsPlacesAndIds) {
  const Component component = parse(
      "select = { where = \"U > 1e5\", sphere.center = [1, 2, 3], sphere.radius = 4 }\n"
      "[component.exclude]\nwhere = [\"RHO <= 3\", \"mass < 1 or mass > 2\"]\nids = \"a.txt\"\n"
      "box = { min = [0, 0, 0], max = [1, 1, 0] }\n");
  EXPECT_THAT(component.select.where, ElementsAre("U > 1e5"));
  EXPECT_EQ(component.select.sphere_center->a[2], 3);
  EXPECT_EQ(component.select.sphere_radius, 4);
  EXPECT_THAT(component.exclude.where, ElementsAre("RHO <= 3", "mass < 1 or mass > 2"));
  EXPECT_EQ(component.exclude.id_file, "a.txt");
  EXPECT_EQ(component.exclude.box_maximum->a[1], 1);
}

TEST(ParticleKeys, PlaceAComponent) {
  const Component component = parse(
      "snapshot = \"galaxy.hdf5\"\ncenter = [1, 0, 0]\norigin = [5e4, 0.125, 0]\nscale = 1e-3\n"
      "rotation = { axis = [0, 1, 0], angle = -30 }\n");
  EXPECT_EQ(component.snapshot, "galaxy.hdf5");
  EXPECT_EQ(component.center.a[0], 1);
  EXPECT_EQ(component.placement.origin->a[1], 0.125);
  EXPECT_EQ(component.placement.axis.a[1], 1);
  EXPECT_EQ(component.placement.angle_degrees, -30);
  EXPECT_EQ(component.placement.scale, 1e-3);
}

TEST(ParticleKeys, MayBeSetOnTheCommandLine) {
  const Scene scene =
      parse_scene("snapshot = \"s\"\n[[component]]\nname = \"gas\"\n", "scene.toml",
                  {"component.gas.select.where=density >= 3", "component.gas.rotation.angle=12",
                   "component.gas.color.vector=Color", "component.gas.absorption_palette=gray"});
  const Component& gas = scene.components[0];
  EXPECT_THAT(gas.select.where, ElementsAre("density >= 3"));
  EXPECT_EQ(gas.placement.angle_degrees, 12);
  EXPECT_EQ(gas.color_vector, "Color");
  EXPECT_EQ(gas.absorption_palette, "gray");
}

TEST(ParticleKeys, TakePathsFromTheFoldersOfTheirFiles) {
  const splotchcl::test::TemporaryFolder folder;
  std::ofstream(folder / "scene.toml") << "snapshot = 's'\n[[component]]\nsnapshot = 'g.hdf5'\n"
                                          "absorption_palette = './p.txt'\n"
                                          "select.ids = 'a.txt'\nexclude.ids = '/b.txt'\n";
  const Component component = read_scene_file(folder / "scene.toml").components.at(0);
  EXPECT_EQ(component.snapshot, (folder / "g.hdf5").string());
  EXPECT_EQ(component.absorption_palette, (folder / "./p.txt").string());
  EXPECT_EQ(component.select.id_file, (folder / "a.txt").string());
  EXPECT_EQ(component.exclude.id_file, "/b.txt");
}

TEST(ColorKeys, OfAVectorMayStandBesideAFieldForAnAbsorptionPalette) {
  EXPECT_NO_THROW(
      parse("color = { vector = \"Color\", field = \"U\" }\nabsorption_palette = \"gray\""));
}

}  // namespace
}  // namespace splotchcl::test
