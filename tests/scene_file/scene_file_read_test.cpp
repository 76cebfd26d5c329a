// What a scene file says, also of columns.
#include "scene_file/scene_checks.h"
#include "splotchcl/palette_file.h"
#include "splotchcl/scene_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

namespace fs = std::filesystem;

Scene parse(const std::string& text) {
  return parse_scene(text, "scene.toml");
}

Component parse_component(const std::string& lines) {
  return parse("[[component]]\n" + lines).components.at(0);
}

TEST(SceneFile, OfNothingIsTheDefaultScene) {
  expect_same(parse(""), Scene());
  expect_same(parse("# only a comment\n"), Scene());
}

void expect_range(const FieldMap& map, const std::string& field, Scaling scaling, double minimum,
                  double maximum) {
  EXPECT_EQ(map.field, field);
  EXPECT_EQ(map.scaling, scaling);
  EXPECT_EQ(map.minimum, minimum);
  EXPECT_EQ(map.maximum, maximum);
}

TEST(SceneFile, TakesEveryKeyOfAPicture) {
  const Scene scene = parse(R"(
snapshot = "snap_006"
tolerance = 0.01
[image]
size = [640, 480]
background = [0.1, 0.2, 0.3]
gamma = 2.2
[camera]
position = [1, 2, 3]
look_at = [4.5, 5, 6]
sky = [0, 0, 1]
field_of_view = 30
projection = "orthographic"
near = -1
far = 100
[kernel]
width = 0.4
cut = 1.815
sampling = "center"
min_radius = 1
[sort]
by = "temperature"
order = "descending"
[[component]]
name = "gas"
types = ["gas", 4]
size = { field = "HSML", factor = 2 }
color = { field = "U", scaling = "log", min = 10, max = 1e6 }
intensity = { field = "RHO", scaling = "asinh", min = -1, max = 2 }
weight = "density"
reference_column = 3e-5
palette = "magma"
brightness = 5
absorption = 0.5
)");
  EXPECT_EQ(scene.snapshot, "snap_006");
  EXPECT_EQ(scene.tolerance, 0.01);
  EXPECT_EQ(scene.image.width, 640);
  EXPECT_EQ(scene.image.height, 480);
  EXPECT_THAT(scene.image.background, ElementsAre(0.1, 0.2, 0.3));
  EXPECT_EQ(scene.image.gamma, 2.2);
  ASSERT_TRUE(scene.camera);
  EXPECT_TRUE(same(scene.camera->position, {{1, 2, 3}}));
  EXPECT_TRUE(same(scene.camera->look_at, {{4.5, 5, 6}}));
  EXPECT_TRUE(same(scene.camera->sky, {{0, 0, 1}}));
  EXPECT_EQ(scene.camera->field_of_view_degrees, 30);
  EXPECT_EQ(scene.camera->projection, Projection::orthographic);
  EXPECT_EQ(scene.camera->near_limit, -1);
  EXPECT_EQ(scene.camera->far_limit, 100);
  EXPECT_EQ(scene.kernel.width, 0.4);
  EXPECT_EQ(scene.kernel.cut, 1.815);
  EXPECT_EQ(scene.kernel.sampling, Sampling::center);
  EXPECT_EQ(scene.kernel.min_radius_pixels, 1);
  EXPECT_EQ(scene.sort.by, SortOrder::By::field);
  EXPECT_EQ(scene.sort.field, "temperature");
  EXPECT_TRUE(scene.sort.descending);
  ASSERT_EQ(scene.components.size(), 1U);
  const Component& gas = scene.components[0];
  EXPECT_EQ(gas.name, "gas");
  EXPECT_THAT(gas.types, ElementsAre(0, 4));
  EXPECT_EQ(gas.size_field, "HSML");
  EXPECT_EQ(gas.size_factor, 2);
  expect_range(gas.color, "U", Scaling::log, 10, 1e6);
  expect_range(gas.intensity, "RHO", Scaling::asinh, -1, 2);
  EXPECT_EQ(gas.weight, WeightModel::density);
  EXPECT_EQ(gas.reference_column, 3e-5);
  EXPECT_EQ(gas.palette, "magma");
  EXPECT_EQ(gas.brightness, 5);
  EXPECT_EQ(gas.absorption.kind, Absorption::Kind::factor);
  EXPECT_EQ(gas.absorption.factor, 0.5);
}

TEST(SceneFile, TakesInnerTablesInEveryWayThatTomlHas) {
  const std::string component = "[[component]]\n";
  const std::string inline_table = "color = { field = \"U\", scaling = \"log\" }\n";
  const std::string dotted = "color.field = \"U\"\ncolor.scaling = \"log\"\n";
  const std::string header = "[component.color]\nfield = \"U\"\nscaling = \"log\"\n";
  expect_same(parse(component + inline_table), parse(component + dotted));
  expect_same(parse(component + inline_table), parse(component + header));
}

TEST(SceneFile, TakesOneSideOfThePictureAlone) {
  const Scene scene = parse("[image]\nheight = 300\n");
  EXPECT_EQ(scene.image.width, ImageSettings().width);
  EXPECT_EQ(scene.image.height, 300);
}

TEST(SceneFile, TakesAParticleTypeByNumberOrNameAloneOrInAnArray) {
  EXPECT_THAT(parse_component("types = 4").types, ElementsAre(4));
  EXPECT_THAT(parse_component("types = \"stars\"").types, ElementsAre(4));
  EXPECT_THAT(parse_component("types = [1, \"boundary\"]").types, ElementsAre(1, 5));
  EXPECT_THAT(parse_component("types = 6").types, ElementsAre(6));
}

TEST(SceneFile, KnowsFourKindsOfAbsorption) {
  using Kind = Absorption::Kind;
  const auto kind = [](const std::string& line) { return parse_component(line).absorption.kind; };
  EXPECT_EQ(kind(""), Kind::as_emission);
  EXPECT_EQ(kind("absorption = \"emission\""), Kind::as_emission);
  EXPECT_EQ(kind("absorption = \"none\""), Kind::none);
  EXPECT_EQ(kind("absorption = 2"), Kind::factor);
  EXPECT_EQ(kind("gray_absorption = 0.2"), Kind::gray);
  EXPECT_EQ(parse_component("absorption = 2").absorption.factor, 2);
  EXPECT_EQ(parse_component("gray_absorption = 0.2").absorption.factor, 0.2);
}

TEST(SceneFile, TakesAbsorptionZeroForNone) {
  EXPECT_EQ(parse_component("absorption = 0").absorption.kind, Absorption::Kind::none);
  EXPECT_EQ(parse_component("absorption = 0.0").absorption.kind, Absorption::Kind::none);
}

TEST(SceneFile, HasNoCameraWithoutACameraTable) {
  EXPECT_FALSE(parse("[image]\nsize = [9, 9]\n").camera);
}

TEST(SceneFile, KeepsItsComponentsInOrder) {
  const Scene scene = parse("[[component]]\nname = \"b\"\n[[component]]\nname = \"a\"\n");
  ASSERT_EQ(scene.components.size(), 2u);
  EXPECT_EQ(scene.components[0].name, "b");
  EXPECT_EQ(scene.components[1].name, "a");
}

class SceneFileOnDisk : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) / "splotchcl_scene_file_test";
    fs::create_directories(folder_ / "deep");
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path write(const std::string& text) const {
    const fs::path path = folder_ / "deep" / "scene.toml";
    std::ofstream(path) << text;
    return path;
  }
  fs::path folder_;
};

TEST_F(SceneFileOnDisk, FindsASnapshotRelativeToItself) {
  const Scene scene = read_scene_file(write("snapshot = \"../snap_006\""));
  EXPECT_TRUE(fs::equivalent(fs::path(scene.snapshot).parent_path(), folder_));
  EXPECT_EQ(fs::path(scene.snapshot).filename(), "snap_006");
}

TEST_F(SceneFileOnDisk, KeepsAnAbsoluteSnapshot) {
  EXPECT_EQ(read_scene_file(write("snapshot = \"/data/snap_006\"")).snapshot, "/data/snap_006");
}

TEST_F(SceneFileOnDisk, FindsAPaletteFileRelativeToItself) {
  const fs::path path = write("snapshot = \"s\"\n[[component]]\npalette = \"my.pal\"");
  std::ofstream(folder_ / "deep" / "my.pal") << "0.5 0.5 0.5\n";
  const Scene scene = read_scene_file(path);
  EXPECT_EQ(load_palette(scene.components[0].palette).emission.size(), 1u);
}

TEST_F(SceneFileOnDisk, LeavesPaletteNamesAlone) {
  const fs::path path = write("snapshot = \"s\"\n[[component]]\npalette = \"magma\"");
  EXPECT_EQ(read_scene_file(path).components[0].palette, "magma");
}

TEST_F(SceneFileOnDisk, TakesPathsOfSettingsAsTheyAre) {
  const fs::path path = write("snapshot = \"s\"\n[[component]]\n");
  const Scene scene = read_scene_file(path, {"snapshot=other/snap", "component.0.palette=./p.pal"});
  EXPECT_EQ(scene.snapshot, "other/snap");
  EXPECT_EQ(scene.components[0].palette, "./p.pal");
}

TEST_F(SceneFileOnDisk, NeedsASnapshot) {
  const fs::path path = write("tolerance = 0.1");
  EXPECT_THAT([&] { read_scene_file(path); },
              ThrowsMessage<UsageError>(
                  AllOf(HasSubstr("key snapshot: found nothing"), HasSubstr(path.string()))));
}

TEST_F(SceneFileOnDisk, MayLeaveTheSnapshotToASetting) {
  EXPECT_EQ(read_scene_file(write("tolerance = 0.1"), {"snapshot=s"}).snapshot, "s");
}

TEST_F(SceneFileOnDisk, ThatIsMissingIsADataErrorThatNamesIt) {
  const fs::path path = folder_ / "no_such.toml";
  EXPECT_THAT([&] { read_scene_file(path); }, ThrowsMessage<DataError>(HasSubstr(path.string())));
}

TEST_F(SceneFileOnDisk, ThatIsAFolderIsADataError) {
  EXPECT_THROW(read_scene_file(folder_), DataError);
}

using ::testing::UnorderedElementsAre;

const std::string start = "snapshot = \"s\"\n[[component]]\ntypes = [0]\n";

TEST(ReadColumns, MayBeATableOfNamesAndColumns) {
  const Scene scene = parse_scene(
      start + "[read]\ncolumns = {x = \"a/b\", \"y [kpc]\" = \"list:y\", z = 3}\n", "scene.toml");
  EXPECT_THAT(scene.read.columns, UnorderedElementsAre("x=a/b", "y [kpc]=list:y", "z=3"));
}

TEST(ReadColumns, AreWrittenAsTheyAreRead) {
  const Scene scene = parse_scene(start + "[read.columns]\nx = \"a/b\"\n", "scene.toml");
  EXPECT_EQ(parse_scene(format_scene(scene), "again.toml").read.columns, scene.read.columns);
}

TEST(ReadColumns, OfOtherKindsAreRefused) {
  for (const char* const value : {"{x = true}", "{}", "{x = \"\"}", "{\"x=y\" = \"a\"}"}) {
    EXPECT_THAT([&] { parse_scene(start + "[read]\ncolumns = " + value + "\n", "scene.toml"); },
                ThrowsMessage<UsageError>(HasSubstr("a table of strings by name")))
        << value;
  }
}

TEST(ReadUnits, AreATableOfFieldsAndUnits) {
  const Scene scene = parse_scene(
      start + "[read]\nunits = {mass = \"Msun\", position = \"kpc/h a\"}\n", "scene.toml");
  EXPECT_THAT(scene.read.units, UnorderedElementsAre("mass=Msun", "position=kpc/h a"));
  EXPECT_EQ(parse_scene(format_scene(scene), "again.toml").read.units, scene.read.units);
}

TEST(ReadUnits, MayBeOfASystem) {
  for (const char* const value : {"\"gadget\"", "[\"gadget\"]"}) {
    const Scene scene = parse_scene(start + "[read]\nunits = " + value + "\n", "scene.toml");
    EXPECT_THAT(scene.read.units, UnorderedElementsAre("gadget"));
    EXPECT_EQ(parse_scene(format_scene(scene), "again.toml").read.units, scene.read.units);
  }
  EXPECT_THAT(apply_settings(Scene(), {"read.units=gadget"}).read.units,
              UnorderedElementsAre("gadget"));
}

TEST(Haloes, HaveNumbersOfAnyLength) {
  for (const std::uint64_t number :
       {std::uint64_t{0}, std::uint64_t{9007199254740993U}, std::uint64_t{18446744073709551615U}}) {
    const Scene scene =
        parse_scene(start + "select.halo = \"" + std::to_string(number) + "\"\n", "scene.toml");
    EXPECT_EQ(scene.components.front().select.halo, number);
    EXPECT_EQ(parse_scene(format_scene(scene), "again.toml").components.front().select.halo,
              number);
  }
}

}  // namespace
}  // namespace splotchcl::test
