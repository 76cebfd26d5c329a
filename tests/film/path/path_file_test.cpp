// Files of paths, and paths of fewer keyframes.
#include <fmt/format.h>

#include <boost/qvm/vec_operations.hpp>

#include "film/path/film_path.h"
#include "film/path/path_messages.h"
#include "splotchcl/scene_file.h"
#include "testing.h"

namespace splotchcl {
namespace {

using test::refusal;

class PathFile : public ::testing::Test {
 protected:
  Scene scene_with(const std::string& text, const std::string& more = "") const {
    std::ofstream(folder_ / "path.txt") << text;
    Scene scene = parse_scene(
        "[camera]\nposition = [0, 0, -5]\nlook_at = [0, 0, 0]\n" + more +
            "[[component]]\nname = 'gas'\ncolor = { field = 'U', scaling = 'log', min = 1 }\n",
        "scene.toml");
    scene.path.file = (folder_ / "path.txt").string();
    return scene;
  }
  std::vector<Scene> frames(const std::string& text) {
    const Scene scene = scene_with(text);
    notes_.clear();
    const FilmPath path(scene, notes_);
    path.check(scene);
    std::vector<Scene> result;
    for (int i = 0; i < path.frame_count(); ++i)
      result.push_back(path.scene_at(scene, i));
    return result;
  }
  std::string message(const std::string& text) {
    return refusal([&] { frames(text); });
  }

  test::TemporaryFolder folder_;
  std::vector<std::string> notes_;
};

TEST_F(PathFile, WithoutAHeaderIsCameraLookAtAndSky) {
  const auto result = frames("1 2 3  4 5 6  0 0 1\n# then\n\n-1e3, +2.5, .5, 4 5 6 0 1 0 # end\n");
  ASSERT_EQ(result.size(), 2U);
  const Camera& first = *result[0].camera;
  EXPECT_EQ(first.position.a[2], 3);
  EXPECT_EQ(first.look_at.a[0], 4);
  EXPECT_EQ(first.sky.a[2], 1);
  EXPECT_EQ(result[1].camera->position.a[0], -1000);
  EXPECT_EQ(result[1].camera->position.a[1], 2.5);
  EXPECT_EQ(result[1].camera->position.a[2], 0.5);
}

TEST_F(PathFile, TakesAnyKeyAsAColumn) {
  const auto result = frames(
      "camera.field_of_view component.gas.brightness component.0.palette image.background.red "
      "image.background.1 image.background.b\n"
      "30 0.5 magma 0.1 0.2 0.3\n");
  EXPECT_EQ(result[0].camera->field_of_view_degrees, 30);
  EXPECT_EQ(result[0].components[0].brightness, 0.5);
  EXPECT_EQ(result[0].components[0].palette, "magma");
  EXPECT_EQ(result[0].image.background, (std::array<double, 3>{0.1, 0.2, 0.3}));
  EXPECT_EQ(result[0].camera->position.a[2], -5);
}

TEST_F(PathFile, KnowsTheOriginalProgramsNames) {
  const auto result =
      frames("fov brightness0 color_max0 lookat_z lookat_y lookat_x\n60 3 2 7 8 9\n");
  EXPECT_EQ(result[0].camera->field_of_view_degrees, 60);
  EXPECT_EQ(result[0].components[0].brightness, 3);
  // The original's limits are logarithms already.
  EXPECT_EQ(result[0].components[0].color.maximum, 100);
  EXPECT_EQ(result[0].camera->look_at.a[0], 9);
  EXPECT_EQ(result[0].camera->look_at.a[2], 7);
}

// The original's minrad_pix is of r = 2 h.
TEST_F(PathFile, HalvesTheOriginalProgramsSmallestRadius) {
  const auto result = frames("minrad_pix kernel.width\n3 0.5\n");
  EXPECT_EQ(result[0].kernel.min_radius_pixels, 1.5);
  EXPECT_EQ(result[0].kernel.width, 0.5);
}

TEST_F(PathFile, NamesFilesFromItsOwnFolder) {
  const auto result = frames(
      "palette0 finish.font image.background_image\n"
      "a.pal DejaVuSans sub/sky.png\nmagma x.ttf /sky.png\n");
  EXPECT_EQ(result[0].components[0].palette, (folder_ / "a.pal").string());
  EXPECT_EQ(result[0].finish.font, "DejaVuSans");
  EXPECT_EQ(result[0].image.background_image, (folder_ / "sub/sky.png").string());
  EXPECT_EQ(result[1].components[0].palette, "magma");
  EXPECT_EQ(result[1].finish.font, (folder_ / "x.ttf").string());
  EXPECT_EQ(result[1].image.background_image, "/sky.png");
}

TEST_F(PathFile, MayNameTheOneSnapshotInEachRow) {
  const std::string row = "1 2 3 4 5 6 0 0 1 92\n";
  EXPECT_EQ(frames(row + row).size(), 2U);
  EXPECT_THAT(notes_, ElementsAre(HasSubstr("index of the snapshot is the same")));
  EXPECT_THAT(message(row + "1 2 3 4 5 6 0 0 1 93\n"), HasSubstr("add a [time] table"));
}

TEST_F(PathFile, OfTheOriginalProgramHasItsFrames) {
  const std::string real = test::data_folder() / "camera" / "anim1_452frames.txt";
  if (!std::filesystem::exists(real)) GTEST_SKIP() << "no " << real;
  const auto result = frames(test::read_text(real));
  ASSERT_EQ(result.size(), 453U);  // 0 to 452
  EXPECT_EQ(result[0].camera->position.a[1], 55747.3828);
  EXPECT_EQ(result[0].camera->sky.a[2], 1);
}

TEST_F(PathFile, IsRefusedWithoutRows) {
  EXPECT_THAT(message("# nothing\n\n"), HasSubstr("path.txt: found no row"));
  EXPECT_THAT(message("camera_x camera_y camera_z\n"), HasSubstr("path.txt: found no row"));
}

TEST_F(PathFile, IsRefusedWithRaggedRows) {
  EXPECT_THAT(message("fov\n30\n\n30 40\n"), HasSubstr("path.txt:4: found 2 values, expected 1"));
}

TEST_F(PathFile, IsRefusedWithTooFewColumnsForNoHeader) {
  EXPECT_THAT(message("1 2 3 4 5 6\n"), HasSubstr("path.txt:1: found 6 columns and no line"));
}

TEST_F(PathFile, IsRefusedWithAPartOfAVector) {
  EXPECT_THAT(message("camera_x camera_z\n1 2\n"),
              HasSubstr("2 of the 3 columns of camera.position, expected camera.position.y"));
}

TEST_F(PathFile, IsRefusedWithUnknownColumns) {
  const std::string text = message("camera.feild_of_view\n1\n");
  EXPECT_THAT(text, HasSubstr("path.txt:1: column 1: found \"camera.feild_of_view\""));
  EXPECT_THAT(text, HasSubstr("did you mean camera.field_of_view?"));
}

TEST_F(PathFile, IsRefusedWithAColumnTwice) {
  EXPECT_THAT(message("fov camera.field_of_view\n1 2\n"), HasSubstr("a second column"));
}

TEST_F(PathFile, IsRefusedWhereTheSizeOfThePictureWouldChange) {
  EXPECT_THAT(message("image.width\n100\n"), HasSubstr("may change within a film"));
}

TEST_F(PathFile, IsRefusedWhereOtherDataWouldBeRead) {
  EXPECT_THAT(message("read.every\n8\n"), HasSubstr("column 1: found read.every, expected keys"));
}

TEST_F(PathFile, IsRefusedWithValuesThatAreNotFinite) {
  const std::string header = "camera_x camera_y camera_z\n";
  for (const std::string word : {"nan", "inf", "-inf", "1e999", "0x10", "one"}) {
    EXPECT_THAT(message(header + "0 0 -9\n0 " + word + " 1\n"),
                HasSubstr("path.txt:3: column 2 (camera_y): found \"" + word + "\""));
  }
}

TEST_F(PathFile, NamesTheColumnsOfAKeyThatIsOutOfRange) {
  EXPECT_THAT(message("fov\n45\n0\n"),
              HasSubstr("path.txt:3: column 1 (fov): key camera.field_of_view: found"));
  EXPECT_THAT(message("fov\n180\n"), HasSubstr("path.txt:2: column 1 (fov)"));
}

TEST_F(PathFile, IsRefusedWithTheCameraAtItsLookAtPoint) {
  EXPECT_THAT(message("lookat_x lookat_y lookat_z\n0 0 1\n0 0 -5\n"),
              HasSubstr("path.txt:3: columns 1, 2, 3 (lookat_x, lookat_y, lookat_z): key "
                        "camera.look_at: found the camera's own position"));
}

TEST_F(PathFile, IsRefusedWithTheSkyAlongTheView) {
  EXPECT_THAT(message("sky_x sky_y sky_z\n0 0 2\n"),
              HasSubstr("path.txt:2: columns 1, 2, 3 (sky_x, sky_y, sky_z): key camera.sky"));
}

TEST_F(PathFile, HasAsManyFramesAsRows) {
  Scene scene = scene_with("fov\n30\n40\n");
  scene.movie.frames = 3;
  EXPECT_THAT(refusal([&] { FilmPath(scene, notes_); }), HasSubstr("found 3, expected 2"));
}

// Recorded flights with fewer keyframes.

using boost::qvm::mag;

constexpr int recorded_frames = 201;

// Around the middle, ever nearer and higher, as a hand would fly: with small trembling.
Scene recorded(double simplify) {
  std::string text =
      "[camera]\nposition = [0, -10, 0]\nlook_at = [0, 0, 0]\nsky = [0, 0, 1]\n"
      "[[component]]\nname = 'gas'\n[path]\n";
  if (simplify > 0) text += fmt::format("simplify = {}\n", simplify);
  for (int i = 0; i < recorded_frames; ++i) {
    const double angle = 0.02 * i, radius = 10 - 0.02 * i;
    text += fmt::format(
        "[[path.keyframes]]\nframe = {}\nposition = [{}, {}, {}]\nlook_at = [0, 0, {}]\n"
        "component.gas.brightness = {}\n",
        i, radius * std::cos(angle), radius * std::sin(angle), 0.01 * i + 0.004 * std::sin(2.7 * i),
        0.002 * i, 1 + 0.3 * std::sin(0.03 * i));
  }
  return parse_scene(text, "flight.toml");
}

std::vector<Scene> film_of(const Scene& scene) {
  std::vector<std::string> notes;
  const FilmPath path(scene, notes);
  std::vector<Scene> all;
  for (int i = 0; i < path.frame_count(); ++i)
    all.push_back(path.scene_at(scene, i));
  return all;
}

TEST(SimplePaths, StayWithinTheToleranceAtEveryFrameThatWasRecorded) {
  constexpr double within = 0.01;
  const std::vector<Scene> all = film_of(recorded(0)), few = film_of(recorded(within));
  ASSERT_EQ(all.size(), few.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Camera &a = *all[i].camera, &b = *few[i].camera;
    const double distance = mag(a.look_at - a.position);
    EXPECT_LE(mag(a.position - b.position), within * distance) << i;
    EXPECT_LE(mag(a.look_at - b.look_at), within * distance) << i;
    EXPECT_NEAR(all[i].components[0].brightness, few[i].components[0].brightness, within * 0.6);
  }
}

TEST(SimplePaths, HaveFewKeyframesAndTellHowMany) {
  std::vector<std::string> notes;
  const Scene simple = with_simple_path(recorded(0.01), notes);
  EXPECT_LE(simple.path.keyframes.size(), 20U);
  EXPECT_GE(simple.path.keyframes.size(), 4U);
  EXPECT_DOUBLE_EQ(simple.path.keyframes.back().frame, recorded_frames - 1);
  EXPECT_THAT(notes, ElementsAre(HasSubstr("of 201 keyframes stay")));
  EXPECT_FALSE(simple.path.simplified_within);
}

TEST(SimplePaths, OfATinyToleranceKeepTheTrembling) {
  std::vector<std::string> notes;
  EXPECT_GT(with_simple_path(recorded(1e-5), notes).path.keyframes.size(), 150U);
}

TEST(SimplePaths, KeepWhatDwellsAndWordsThatChange) {
  Scene scene = recorded(0.05);
  scene.path.keyframes[37].is_eased = true;
  for (std::size_t i = 0; i < scene.path.keyframes.size(); ++i)
    scene.path.keyframes[i].values["component.gas.palette"] = i < 112 ? "'gray'" : "'white'";
  std::vector<std::string> notes;
  bool has_eased = false, has_new_word = false;
  for (const Keyframe& keyframe : with_simple_path(scene, notes).path.keyframes) {
    has_eased |= keyframe.frame == 37 && keyframe.is_eased;
    has_new_word |= keyframe.frame == 112;
  }
  EXPECT_TRUE(has_eased);
  EXPECT_TRUE(has_new_word);
}

}  // namespace
}  // namespace splotchcl
