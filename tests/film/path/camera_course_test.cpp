// Cameras that follow and approach, and how fast they go.
#include "film/path/camera_course.h"

#include <boost/qvm/vec_operations.hpp>

#include "film/path/film_path.h"
#include "film/path/keyframe_tracks.h"
#include "film/path/path_messages.h"
#include "film/path/view_line.h"
#include "scene/expect_near.h"
#include "splotchcl/camera.h"
#include "splotchcl/scene_file.h"
#include "testing.h"

namespace splotchcl {
namespace {

using boost::qvm::dot;
using boost::qvm::mag;
using boost::qvm::normalized;
using namespace test;

// Looks along y at a point that is 10 away, over a picture that is 10 wide there.
const std::string head =
    "[image]\nsize = [200, 100]\n"
    "[camera]\nposition = [0, -10, 0]\nlook_at = [0, 0, 0]\nsky = [0, 0, 1]\nwidth = 10\n";
const std::string tail = "[[component]]\nname = 'gas'\n";

// What goes along x by 10 in each snapshot, with a radius of 3 and an angular momentum that turns
// from z to x.
FollowedWay moving_way(const Scene&, const std::vector<double>&) {
  return FollowedWay({{0, {{100, 0, 0}}, {{0, 0, 1}}}, {1, {{110, 0, 0}}, {{1, 0, 0}}}}, 3,
                     FollowedWay::Kind::straight);
}

std::vector<Scene> film_of(const std::string& path, std::vector<std::string>& notes) {
  const Scene scene = parse_scene(head + path + tail, "scene.toml");
  const FilmPath film(scene, notes, moving_way);
  film.check(scene);
  std::vector<Scene> frames;
  for (int i = 0; i < film.frame_count(); ++i)
    frames.push_back(film.scene_at(scene, i));
  return frames;
}
std::vector<Scene> film_of(const std::string& path) {
  std::vector<std::string> notes;
  return film_of(path, notes);
}

const std::string in_time =
    "[time]\nsnapshots = 'snapshot_%d'\n"
    "[[path.keyframes]]\nframe = 0\ntime.index = 0\n"
    "[[path.keyframes]]\nframe = 2\ntime.index = 1\n";

TEST(FollowedCamera, KeepsItsDirectionAndShowsTheWantedSize) {
  const auto film = film_of(in_time + "[path.follow]\nsphere.center = 'densest'\nsize = 4\n");
  ASSERT_EQ(film.size(), 3U);
  expect_near(film[0].camera->look_at, {{100, 0, 0}}, 1e-12);
  expect_near(film[1].camera->look_at, {{105, 0, 0}}, 1e-12);
  for (const Scene& frame : film) {
    const CameraFrame camera = make_camera_frame(*frame.camera, 200, 100);
    EXPECT_NEAR(100 / camera.pixels_per_length, 4 * 3, 1e-9);
    expect_near(camera.forward, {{0, 1, 0}}, 1e-12);
  }
}

TEST(FollowedCamera, CountsKeyframesFromWhatItFollows) {
  const auto film = film_of(
      in_time + "[[path.keyframes]]\nframe = 3\nposition = [0, 0, 7]\nlook_at = [1, 0, 0]\n" +
      "[path.follow]\nhalo = 0\n");
  expect_near(film[1].camera->position, {{105, 0, 7}}, 1e-12);
  expect_near(film[1].camera->look_at, {{106, 0, 0}}, 1e-12);
}

TEST(FollowedCamera, OrbitsAroundIt) {
  const auto film =
      film_of(in_time + "[path.orbit]\ndegrees = 270\nradius = 20\n" + "[path.follow]\nhalo = 0\n");
  expect_near(film[0].camera->position, {{100, -20, 0}}, 1e-9);
  expect_near(film[1].camera->position, {{125, 0, 0}}, 1e-9);
}

TEST(FollowedCamera, TurnsWithTheAngularMomentum) {
  const auto film = film_of(in_time + "[path.follow]\nhalo = 0\nup = 'angular_momentum'\n");
  expect_near(film[0].camera->sky, {{0, 0, 1}}, 1e-12);
  expect_near(film[2].camera->sky, {{1, 0, 0}}, 1e-12);
  expect_near(normalized(film[2].camera->position - film[2].camera->look_at), {{0, -1, 0}}, 1e-12);
}

TEST(FollowedCamera, NeedsParticles) {
  std::vector<std::string> notes;
  const Scene scene =
      parse_scene(head + "[path.follow]\nhalo = 0\n[movie]\nframes = 2\n" + tail, "scene.toml");
  EXPECT_THAT(refusal([&] { FilmPath(scene, notes); }), HasSubstr("path.follow"));
}

double shown_width(const Scene& frame) {
  return 200 / make_camera_frame(*frame.camera, 200, 100).pixels_per_length;
}

TEST(Approach, EndsWithTheWantedWidthAtItsEnd) {
  const auto film =
      film_of("[path.approach]\nto = [3, 4, 0]\nwidth = 0.01\n[movie]\nframes = 50\n");
  EXPECT_NEAR(shown_width(film.front()), 10, 1e-9);
  EXPECT_NEAR(shown_width(film.back()), 0.01, 1e-12);
  expect_near(film.front().camera->look_at, {{0, 0, 0}}, 1e-12);
  expect_near(film.back().camera->look_at, {{3, 4, 0}}, 1e-12);
}

TEST(Approach, ScalesByTheSameFactorInEqualTimesWhereNothingMoves) {
  const ZoomCurve curve(1000, 1, 0);
  EXPECT_NEAR(curve.at(1.0 / 3).width, 100, 1e-9);
  EXPECT_NEAR(curve.at(2.0 / 3).width, 10, 1e-9);
}

TEST(Approach, NeverMovesByMuchOfWhatItShows) {
  const ZoomCurve curve(1000, 1, 400);
  constexpr int steps = 1000;
  for (int i = 0; i < steps; ++i) {
    const auto a = curve.at(static_cast<double>(i) / steps);
    const auto b = curve.at(static_cast<double>(i + 1) / steps);
    EXPECT_LT(400 * (b.part - a.part) / b.width, 0.02) << i;
    EXPECT_LT(std::abs(std::log(b.width / a.width)), 0.02) << i;
  }
  EXPECT_NEAR(curve.at(1 - 1e-12).part, 1, 1e-9);
  EXPECT_NEAR(curve.at(1 - 1e-12).width, 1, 1e-9);
}

TEST(Approach, IsRefusedWithoutAnEnd) {
  EXPECT_THAT(refusal([] { film_of("[path.approach]\nwidth = 1\n[movie]\nframes = 2\n"); }),
              HasSubstr("path.approach.to"));
  EXPECT_THAT(refusal([] { film_of("[path.approach]\nto = [1, 0, 0]\n"); }),
              HasSubstr("path.approach.width"));
}

TEST(EasedOrbit, ArrivesWithTheLastFrameAndSlowsDown) {
  const auto film = film_of("[path.orbit]\ndegrees = 90\nease = 'both'\n[movie]\nframes = 101\n");
  expect_near(film[100].camera->position, {{10, 0, 0}}, 1e-9);
  const double first = mag(film[1].camera->position - film[0].camera->position);
  const double middle = mag(film[51].camera->position - film[50].camera->position);
  EXPECT_LT(first, 0.05 * middle);
}

TEST(KeyframePace, IsTheFrameWhereNothingStops) {
  EXPECT_FALSE(KeyframePace::changes({{0, 0, false}, {10, 0, false}}));
}

TEST(KeyframePace, DwellsAndGoesOn) {
  const KeyframePace pace({{0, 0, false}, {10, 5, false}, {30, 0, false}});
  for (const double frame : {10.0, 12.5, 15.0})
    EXPECT_EQ(pace.place_at(frame), 10);
  EXPECT_EQ(pace.place_at(30), 30);
  EXPECT_EQ(pace.place_at(0), 0);
}

TEST(KeyframePace, NeverGoesBackAndItsSpeedNeverJumps) {
  const KeyframePace pace({{0, 0, true}, {10, 5, false}, {30, 0, false}, {40, 0, true}});
  constexpr double step = 0.01;
  double before = 0;
  for (double frame = step; frame < 40; frame += step) {
    const double speed = (pace.place_at(frame) - pace.place_at(frame - step)) / step;
    EXPECT_GE(speed, -1e-9) << frame;
    EXPECT_LT(std::abs(speed - before), 0.02) << frame;
    before = speed;
  }
}

TEST(Keyframes, ReadAndWriteTheirSpeed) {
  const Scene scene = parse_scene(
      head + "[[path.keyframes]]\nframe = 0\nease = true\ndwell = 5\ncamera.near = 1\n" + tail,
      "scene.toml");
  const Keyframe read = parse_scene(format_scene(scene), "scene.toml").path.keyframes.at(0);
  EXPECT_TRUE(read.is_eased);
  EXPECT_EQ(read.dwell, 5);
}

TEST(SlowTurns, LookAheadToASharpCorner) {
  std::vector<Vec3> views(30, Vec3{{1, 0, 0}});
  views.resize(60, Vec3{{0, 1, 0}});
  constexpr double most = 0.1;
  const std::vector<Vec3> slow = with_slow_turns(views, most);
  ASSERT_EQ(slow.size(), views.size());
  EXPECT_LE(largest_turn(slow), most * (1 + 1e-6));
  expect_near(slow.front(), views.front(), 1e-12);
  expect_near(slow.back(), views.back(), 1e-12);
  EXPECT_LT(slow[28].a[0], 0.99);  // has begun to turn
}

TEST(SlowTurns, CannotSlowDownWhatAlwaysTurns) {
  std::vector<Vec3> views;
  for (int i = 0; i < 36; ++i)
    views.push_back({{std::cos(0.17 * i), std::sin(0.17 * i), 0}});
  EXPECT_TRUE(with_slow_turns(views, 0.01).empty());
}

TEST(SlowTurns, AreToldAndKeptToInAFilm) {
  const std::string corner =
      "[path.fly]\nthrough = [[0, 0, 0], [100, 0, 0], [100, 100, 0]]\n"
      "[movie]\nframes = 100\nframes_per_second = 25\n[path]\nmax_turn_rate = 60\n";
  std::vector<std::string> notes;
  const auto film = film_of(corner, notes);
  std::vector<Vec3> views;
  for (const Scene& frame : film)
    views.push_back(normalized(frame.camera->look_at - frame.camera->position));
  EXPECT_LE(largest_turn(views) * 25 * 57.2957795, 60 * (1 + 1e-6));
  EXPECT_THAT(notes, ElementsAre(HasSubstr("looks ahead")));
}

// 360 degrees in 450 frames are 20 in the second of 25.
TEST(SlowTurns, TellHowManyFramesAnOrbitNeeds) {
  const auto orbit = [](int frames) {
    return "[path.orbit]\ndegrees = 360\n[path]\nmax_turn_rate = 20\n[movie]\nframes = " +
           std::to_string(frames) + "\n";
  };
  EXPECT_THAT(refusal([&] { film_of(orbit(50)); }), HasSubstr("--set movie.frames=450"));
  EXPECT_EQ(film_of(orbit(450)).size(), 450U);
}

TEST(MotionBlur, DrawsFramesFromBetweenThem) {
  const Scene scene = parse_scene(head +
                                      "[[path.keyframes]]\nframe = 0\ncamera.near = 0\n"
                                      "[[path.keyframes]]\nframe = 2\ncamera.near = 2\n"
                                      "[path]\ninterpolation = 'linear'\n"
                                      "[movie]\nmotion_blur = { shutter = 0.5, samples = 2 }\n" +
                                      tail,
                                  "scene.toml");
  std::vector<std::string> notes;
  const auto scenes = FilmPath(scene, notes).blurred_scenes(scene, 1);
  ASSERT_EQ(scenes.size(), 2U);
  EXPECT_NEAR(*scenes[0].camera->near_limit, 0.875, 1e-12);
  EXPECT_NEAR(*scenes[1].camera->near_limit, 1.125, 1e-12);
}

}  // namespace
}  // namespace splotchcl
