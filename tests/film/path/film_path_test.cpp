#include "film/path/film_path.h"

#include <boost/qvm/vec_operations.hpp>

#include "film/path/path_messages.h"
#include "scene/expect_near.h"
#include "splotchcl/scene_file.h"
#include "testing.h"

namespace splotchcl {
namespace {

using boost::qvm::mag;
using namespace test;

std::vector<Scene> frames_of(const Scene& scene) {
  std::vector<std::string> notes;
  const FilmPath path(scene, notes);
  path.check(scene);
  std::vector<Scene> frames;
  for (int i = 0; i < path.frame_count(); ++i)
    frames.push_back(path.scene_at(scene, i));
  return frames;
}

const std::string camera =
    "[camera]\nposition = [10, 0, 0]\nlook_at = [0, 0, 0]\nsky = [0, 0, 1]\n";
const std::string component = "[[component]]\nname = 'gas'\n";

std::vector<Scene> frames(const std::string& text) {
  return frames_of(parse_scene(camera + text + component, "scene.toml"));
}
std::string message(const std::string& text) {
  return refusal([&] { frames(text); });
}

TEST(Orbit, GoesOnceAroundTheLookAtPoint) {
  const auto film = frames("[path.orbit]\ndegrees = 360\n[movie]\nframes = 4\n");
  ASSERT_EQ(film.size(), 4U);
  expect_near(film[0].camera->position, {{10, 0, 0}}, 1e-14);
  expect_near(film[1].camera->position, {{0, 10, 0}}, 1e-14);
  expect_near(film[3].camera->position, {{0, -10, 0}}, 1e-14);
  expect_near(film[3].camera->look_at, {{0, 0, 0}}, 0);
}

TEST(Orbit, TurnsLookAtPointAndSkyAboutAnAxisOfItsOwn) {
  const auto film = frames(
      "[path.orbit]\ndegrees = 180\ncenter = [5, 0, 0]\naxis = [1, 0, 0]\nradius = 2\n"
      "[movie]\nframes = 2\n");
  expect_near(film[1].camera->position, {{7, 0, 0}}, 1e-14);
  expect_near(film[1].camera->sky, {{0, -1, 0}}, 1e-14);
}

TEST(FlyThrough, LooksAheadAtConstantSpeed) {
  const auto film = frames("[path.fly]\nthrough = [[0, 0, 0], [9, 0, 0]]\n[movie]\nframes = 4\n");
  for (int i = 0; i < 4; ++i) {
    const Camera& at = *film[static_cast<std::size_t>(i)].camera;
    expect_near(at.position, {{3.0 * i, 0, 0}}, 1e-12);
    expect_near(at.look_at, {{3.0 * i + 10, 0, 0}}, 1e-12);
  }
}

TEST(FlyThrough, MayStartAndEndSlowly) {
  const auto film = frames(
      "[path.fly]\nthrough = [[0, 0, 0], [32, 0, 0]]\nlook_at = [16, 5, 0]\nease = 'both'\n"
      "[movie]\nframes = 5\n");
  expect_near(film[1].camera->position, {{5, 0, 0}}, 1e-12);  // (3 - 2/4) / 16 of the way
  expect_near(film[2].camera->position, {{16, 0, 0}}, 1e-12);
  expect_near(film[2].camera->look_at, {{16, 5, 0}}, 0);
}

TEST(Keyframes, MoveEachKeyByItself) {
  const auto film = frames(
      "[path]\ninterpolation = 'linear'\n"
      "[[path.keyframes]]\nframe = 0\nposition = [10, 0, 0]\ncomponent.gas.brightness = 1\n"
      "[[path.keyframes]]\nframe = 2\ncomponent.gas.brightness = 2\n"
      "component.gas.palette = 'magma'\n"
      "[[path.keyframes]]\nframe = 4\nposition = [10, 8, 0]\n");
  ASSERT_EQ(film.size(), 5U);
  expect_near(film[1].camera->position, {{10, 2, 0}}, 1e-14);
  EXPECT_EQ(film[1].components[0].brightness, 1.5);
  EXPECT_EQ(film[4].components[0].brightness, 2);
  EXPECT_EQ(film[4].components[0].palette, "magma");
}

TEST(Keyframes, LeaveValuesWithinTheirRange) {
  const auto film = frames(
      "[[path.keyframes]]\nframe = 0\ncomponent.gas.brightness = 0\n"
      "[[path.keyframes]]\nframe = 10\ncomponent.gas.brightness = 0\n"
      "[[path.keyframes]]\nframe = 12\ncomponent.gas.brightness = 100\n"
      "[[path.keyframes]]\nframe = 40\ncomponent.gas.brightness = 99\n");
  for (const Scene& frame : film) {
    EXPECT_GE(frame.components[0].brightness, 0);
    EXPECT_LE(frame.components[0].brightness, 100);
  }
}

TEST(Keyframes, TurnTheSkyAsARotation) {
  const auto film = frames(
      "[[path.keyframes]]\nframe = 0\nsky = [0, 0, 3]\n"
      "[[path.keyframes]]\nframe = 3\nsky = [0, 1, 0]\n");
  expect_near(film[1].camera->sky, {{0, 0.5, std::sqrt(0.75)}}, 1e-14);
}

// From one side to the other: the look-at point itself would pass through the camera.
TEST(Keyframes, TurnTheViewWhereItsDirectionIsInterpolated) {
  const std::string turn =
      "[[path.keyframes]]\nframe = 0\nposition = [0, 0, 0]\nlook_at = [8, 0, 0]\n"
      "[[path.keyframes]]\nframe = 2\nposition = [0, 0, 0]\nlook_at = [-8, 1e-9, 0]\n";
  const auto film = frames("[path]\nlook = 'direction'\n" + turn);
  expect_near(film[1].camera->look_at, {{0, 8, 0}}, 1e-8);
}

TEST(Keyframes, MoveTheLookAtPointOtherwise) {
  const auto film = frames(
      "[[path.keyframes]]\nframe = 0\nlook_at = [0, 4, 0]\n"
      "[[path.keyframes]]\nframe = 2\nlook_at = [0, -4, 2]\n");
  expect_near(film[1].camera->look_at, {{0, 0, 1}}, 1e-14);
}

TEST(Keyframes, GoTogetherWithAnOrbit) {
  const auto film = frames(
      "[path.orbit]\ndegrees = 90\n"
      "[[path.keyframes]]\nframe = 0\ncamera.field_of_view = 30\n"
      "[[path.keyframes]]\nframe = 8\ncamera.field_of_view = 60\n");
  ASSERT_EQ(film.size(), 9U);
  EXPECT_EQ(film[8].camera->field_of_view_degrees, 60);
  expect_near(film[8].camera->position,
              {{10 * std::cos(80 * M_PI / 180), 10 * std::sin(80 * M_PI / 180), 0}}, 1e-13);
}

TEST(Keyframes, AreRefusedWhereTheyAreOfDifferentKinds) {
  EXPECT_THAT(message("[[path.keyframes]]\nframe = 0\ncomponent.gas.brightness = 1\n"
                      "[[path.keyframes]]\nframe = 2\ncomponent.gas.brightness = 'high'\n"),
              HasSubstr("component.gas.brightness at frame 2 is of another kind"));
}

TEST(Keyframes, NameFilesFromTheScenesFolder) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "scene.toml") << "snapshot = 's'\n" + camera + component +
                                              "[[path.keyframes]]\nframe = 0\n"
                                              "component.gas.palette = 'a.pal'\n"
                                              "[[path.keyframes]]\nframe = 1\n"
                                              "component.gas.palette = 'magma'\n";
  const auto film = frames_of(read_scene_file(folder / "scene.toml"));
  EXPECT_EQ(film[0].components[0].palette, (folder / "a.pal").string());
  EXPECT_EQ(film[1].components[0].palette, "magma");
}

TEST(Keyframes, AreRefusedOutOfOrder) {
  EXPECT_THAT(message("[[path.keyframes]]\nframe = 2\nsky = [0, 0, 1]\n"
                      "[[path.keyframes]]\nframe = 2\nsky = [0, 0, 1]\n"),
              HasSubstr("in increasing order of frame"));
}

TEST(Keyframes, AreRefusedWhereTheSizeOfThePictureWouldChange) {
  EXPECT_THAT(message("[[path.keyframes]]\nframe = 0\nimage.size = [10, 10]\n"),
              HasSubstr("image.size, expected keys that may change"));
}

TEST(Keyframes, AreRefusedWhereOtherDataWouldBeRead) {
  EXPECT_THAT(message("[[path.keyframes]]\nframe = 0\nread.every = 8\n"
                      "[[path.keyframes]]\nframe = 4\nread.every = 1\n"),
              HasSubstr("read.every, expected keys that may change within a film; its data is read "
                        "once"));
}

TEST(FilmPath, NamesTheFrameThatCannotBeDrawn) {
  EXPECT_THAT(message("[[path.keyframes]]\nframe = 0\nlook_at = [0, 0, 0]\n"
                      "[[path.keyframes]]\nframe = 4\nlook_at = [20, 0, 0]\n"),
              HasSubstr("frame 2 of the path: key camera.look_at: found the camera's own"));
  EXPECT_THAT(message("[[path.keyframes]]\nframe = 0\ncamera.feild_of_view = 3\n"),
              HasSubstr("frame 0 of the path: key camera.feild_of_view: found an unknown key"));
}

TEST(FilmPath, NeedsAPathOrANumberOfFrames) {
  EXPECT_THAT(message(""), HasSubstr("path: found nothing"));
  EXPECT_THAT(message("[path.orbit]\ndegrees = 3\n"), HasSubstr("movie.frames: found nothing"));
  EXPECT_EQ(frames("[movie]\nframes = 7\n").size(), 7U);
}

TEST(PathSettings, ReplaceEachOtherBySettings) {
  const Scene orbit = parse_scene("[path.orbit]\ndegrees = 90\n", "scene.toml");
  const Scene fly = apply_settings(orbit, {"path.fly.through=[[0, 0, 0], [1, 0, 0]]"});
  EXPECT_TRUE(fly.path.fly && !fly.path.orbit);
  EXPECT_THAT(
      refusal([] { parse_scene("[path]\nfile = 'a'\norbit = { degrees = 90 }\n", "scene.toml"); }),
      HasSubstr("only one of the two"));
}

}  // namespace
}  // namespace splotchcl
