// The keys of components' particles in scene files.
#include "load/particles.h"
#include "splotchcl/scene_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

Component parse(const std::string& lines) {
  return parse_scene("snapshot = \"s\"\n[[component]]\n" + lines, "scene.toml").components.at(0);
}

std::string refused(const std::string& lines) {
  return refusal_by<UsageError>([&] { parse(lines); });
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

TEST(ParticleKeys, RefuseWhatIsNoSelection) {
  EXPECT_THAT(refused("select.where = \"mass = 3\""),
              HasSubstr("scene.toml:3: key component.0.select.where: condition: found = at "
                        "character 6 of \"mass = 3\", "
                        "expected == to compare"));
  EXPECT_THAT(refused("select.where = [\"mass > 3\", \"heavy\"]"), HasSubstr("select.where"));
  EXPECT_THAT(refused("select.where = []"), HasSubstr("select.where"));
  EXPECT_THAT(refused("select.where = 3"), HasSubstr("select.where"));
  EXPECT_THAT(refused("select = \"mass > 3\""),
              HasSubstr("expected a table with keys such as where"));
  EXPECT_THAT(refused("select.were = \"mass > 3\""),
              HasSubstr("did you mean component.0.select.where"));
  EXPECT_THAT(refused("select.ids = \"\""), HasSubstr("select.ids"));
  EXPECT_THAT(refused("select.sphere = { center = [0, 0, 0], radius = 0 }"),
              HasSubstr("expected a number > 0"));
  EXPECT_THAT(refused("select.sphere.radius = 1"), HasSubstr("select.sphere.center as well"));
  EXPECT_THAT(refused("exclude.box.min = [0, 0, 0]"), HasSubstr("exclude.box.max as well"));
  EXPECT_THAT(refused("exclude.box = { min = [0, 2, 0], max = [1, 1, 1] }"),
              HasSubstr("found 2 along y, expected at most component.0.exclude.box.max"));
}

TEST(ParticleKeys, RefuseWhatIsNoPlacement) {
  EXPECT_THAT(refused("scale = 0"), HasSubstr("expected a number > 0"));
  EXPECT_THAT(refused("origin = [0, 0]"), HasSubstr("component.0.origin"));
  EXPECT_THAT(refused("rotation.axis = [0, 0, 0]"), HasSubstr("expected a direction"));
  EXPECT_THAT(refused("rotation.angle = inf"), HasSubstr("expected a finite number"));
  EXPECT_THAT(refused("snapshot = \"\""), HasSubstr("component.0.snapshot"));
}

TEST(ColorKeys, RefuseWhatDoesNothingOrIsNoRange) {
  EXPECT_THAT(refused("color = { vector = \"Color\", field = \"U\" }"),
              HasSubstr("only one of the two, or an absorption_palette"));
  EXPECT_EQ(refused("color = { vector = \"Color\", field = \"U\" }\nabsorption_palette = \"gray\""),
            "");
  EXPECT_THAT(refused("color.percentiles = [1, 99]"), HasSubstr("color.field as well"));
  for (const char* wrong : {"[99, 1]", "[5, 5]", "[-1, 50]", "[1, 101]", "[1]", "50"}) {
    EXPECT_THAT(refused(std::string("color = { field = \"U\", percentiles = ") + wrong + " }"),
                HasSubstr("numbers from 0 to 100 with low < high"))
        << wrong;
  }
}

}  // namespace
}  // namespace splotchcl::test
