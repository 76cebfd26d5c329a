// Recorded flights with fewer keyframes.
#include "film/path/simplify_path.h"

#include <fmt/format.h>

#include <boost/qvm/vec_operations.hpp>

#include "film/path/film_path.h"
#include "splotchcl/scene_file.h"
#include "testing.h"

namespace splotchcl {
namespace {

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
