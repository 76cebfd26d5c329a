// What becomes of each key of a parameter file.
#include "scene_file/scene_checks.h"
#include "splotchcl/palette_file.h"
#include "splotchcl/par_file.h"
#include "splotchcl/scene_file.h"
#include "testing.h"
#include "text_rows.h"

namespace splotchcl {
namespace {

const std::string least =
    "infile=snap_\nfidx=92\nperiodic=F\nsize_label0=HSML\ncolor_label0=U\npalette0=a.pal\n"
    "camera_x=1\ncamera_y=2\ncamera_z=3\nlookat_x=4\nlookat_y=5\nlookat_z=6\nsky_z=1\n";

class ParScenes : public ::testing::Test {
 protected:
  Scene read(const std::string& more = "", const std::vector<std::string>& settings = {}) {
    std::ofstream(folder_ / "a.pal") << "a\n0100\n2\n0 0 0\n255 255 255\n";
    std::ofstream(folder_ / "x.path") << "camera_x camera_y camera_z lookat_x lookat_y lookat_z\n"
                                         "7 8 9 0 0 0\n1 1 1 0 0 0\n";
    std::ofstream(folder_ / "factors.path") << "size_fac0 color_min0\n1 2\n";
    std::ofstream(folder_ / "x.par") << least << more;
    notes_.clear();
    return read_par_file(folder_ / "x.par", settings, notes_);
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  test::TemporaryFolder folder_;
  std::vector<std::string> notes_;
};

class ParKeys : public ParScenes, public ::testing::WithParamInterface<test::TextRow> {};

TEST_P(ParKeys, BecomeThoseOfScenes) {
  Scene scene;
  const std::string refused =
      test::refusal_by<UsageError>([&] { scene = read(GetParam().texts.front()); });
  bool may_be_refused = false;
  for (std::string part : GetParam().expected) {
    SCOPED_TRACE(part);
    if (const std::size_t folder = part.find("FOLDER"); folder != std::string::npos)
      part.replace(folder, 6, folder_.path().string());
    const std::size_t is = part.find(" is ");
    if (part.rfind("refused ", 0) == 0) {
      may_be_refused = true;
      EXPECT_THAT(refused, HasSubstr(part.substr(8)));
    } else if (part.rfind("note ", 0) == 0) {
      EXPECT_THAT(notes_, Contains(HasSubstr(part.substr(5))));
    } else if (part == "no notes") {
      EXPECT_THAT(notes_, IsEmpty());
    } else {
      ASSERT_NE(is, std::string::npos);
      ASSERT_EQ(refused, "");
      EXPECT_EQ(test::value_of(scene, part.substr(0, is)), part.substr(is + 4));
    }
  }
  EXPECT_EQ(refused.empty(), !may_be_refused) << refused;
}

INSTANTIATE_TEST_SUITE_P(Rows, ParKeys,
                         ::testing::ValuesIn(test::read_text_rows(test::source_folder() /
                                                                  "tests/par/keys.rows")),
                         [](const auto& info) { return info.param.name; });

TEST_F(ParScenes, TakeAWholeNameWhereOnlyThatExists) {
  std::ofstream(folder_ / "snap_") << "a snapshot";
  EXPECT_EQ(read().snapshot, path("snap_"));
  std::ofstream(folder_ / "snap_092") << "a snapshot";
  EXPECT_EQ(read().snapshot, path("snap_092"));
}

TEST_F(ParScenes, BetweenSnapshotsAreSequences) {
  const Scene scene = read(
      "fidx=92.25\ninterpolation_mode=2\nomega=0.3\nlambda=0.7\nl_unit=3.0856775814913673e24\nv_"
      "unit=1e5\nhubble=0.7\n");
  EXPECT_EQ(scene.time.pattern, path("snap_%03d"));
  EXPECT_EQ(scene.time.index, 92.25);
  EXPECT_EQ(scene.time.interpolation, Interpolation::hermite);
  EXPECT_EQ(scene.time.omega_matter, 0.3);
  EXPECT_NEAR(*scene.time.hubble_rate, 100, 1e-9);  // lengths in Mpc/h
  EXPECT_TRUE(scene.snapshot.empty());
}

TEST_F(ParScenes, HaveRangesBeforeScaling) {
  const Component component = read("color_min0=2\ncolor_max0=6\ncolor_fac0=100\n").components[0];
  EXPECT_EQ(component.color.scaling, Scaling::log);
  EXPECT_NEAR(*component.color.minimum, 1, 1e-12);
  EXPECT_NEAR(*component.color.maximum, 1e4, 1e-8);
  const Component linear = read("color_log0=F\ncolor_min0=-2\ncolor_max0=6\n").components[0];
  EXPECT_EQ(linear.color.scaling, Scaling::linear);
  EXPECT_EQ(linear.color.minimum, -2);
  const Component asinh =
      read("color_log0=F\ncolor_asinh0=T\ncolor_min0=0\ncolor_max0=3\n").components[0];
  EXPECT_EQ(asinh.color.scaling, Scaling::asinh);
  EXPECT_NEAR(*asinh.color.maximum, std::sinh(3), 1e-12);
}

TEST_F(ParScenes, TakeSettings) {
  EXPECT_EQ(read("", {"image.width=99"}).image.width, 99);
}

TEST_F(ParScenes, AreTheSameAsTheSceneFilesTheyAreConvertedTo) {
  const Scene scene = read("fov=30\nptypes=1\nbrightness0=10.5\n");
  std::filesystem::create_directory(folder_ / "scenes");
  std::ofstream(folder_ / "scenes/x.toml")
      << format_scene(with_paths_from(scene, folder_ / "scenes"));
  const Scene converted = read_scene_file(folder_ / "scenes/x.toml");
  EXPECT_EQ(std::filesystem::path(converted.snapshot).lexically_normal(),
            std::filesystem::path(scene.snapshot).lexically_normal());
  EXPECT_EQ(converted.components[0].reference_column, scene.components[0].reference_column);
  EXPECT_EQ(converted.kernel.cut, scene.kernel.cut);
}

TEST(RealParFiles, BecomeScenes) {
  const std::filesystem::path data = test::data_folder();
  if (!std::filesystem::is_directory(data)) GTEST_SKIP() << "no real files in " << data;
  for (const char* const name : {"demo.par", "g51.par", "sample.par"}) {
    SCOPED_TRACE(name);
    std::vector<std::string> notes;
    const Scene scene = read_par_file(data / "splotch_par" / name, {}, notes);
    EXPECT_EQ(scene.components.size(), 2U);
    EXPECT_THAT(scene.snapshot, HasSubstr("snap_092"));
    EXPECT_NO_THROW(load_palette(scene.components[0].palette));
    EXPECT_THAT(notes, Not(Contains(HasSubstr("is not known"))));
  }
}

}  // namespace
}  // namespace splotchcl
