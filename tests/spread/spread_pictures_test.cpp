// Each rank has its own particles, and the picture is that of all of them.
#include "splotchcl/frame_drawer.h"
#include "splotchcl/load.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/spread_snapshot.h"
#include "spread/component_texts.h"
#include "spread/simulation.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

const std::string outside = "[camera]\nposition = [0, -4, 1]\nlook_at = [0, 0, 0]\n";
const std::string inside =
    "[camera]\nposition = [0, -0.2, 0]\nlook_at = [0, 1, 0]\nsky = [0, 0, 1]\n";
const std::string gas_of_picture = gas_component, stars_of_picture = stars_component;
const std::string emission = gas_of_picture + "absorption = 0\n";
const std::string ordered = gas_of_picture + "absorption = 0.2\n" + stars_of_picture;

DrawnFrame draw_alone(const Arrays& arrays, const std::string& scene) {
  ArraySnapshot all;
  set_fields(arrays, all);
  return FrameDrawer().draw(parse_scene(scene, "scene"), all);
}

std::vector<DrawnFrame> draw_spread(const Arrays& arrays, const Ends& ends,
                                    const std::string& scene) {
  std::vector<DrawnFrame> drawn(ends.size());
  ThreadRanks::run(static_cast<int>(ends.size()), [&](Communicator& ranks) {
    const Arrays part = part_of_rank(arrays, ends, ranks.rank());
    ArraySnapshot own;
    set_fields(part, own);
    FrameDrawerOptions options;
    options.ranks = borrowed(ranks);
    FrameDrawer drawer(options);
    const SpreadSnapshot all(own, options.ranks);
    drawn[static_cast<std::size_t>(ranks.rank())] = drawer.draw(parse_scene(scene, "scene"), all);
  });
  return drawn;
}

void expect_same(const DrawnFrame& drawn, const DrawnFrame& alone, const std::string& what) {
  ASSERT_EQ(drawn.pictures.size(), alone.pictures.size()) << what;
  for (std::size_t i = 0; i < alone.pictures.size(); ++i)
    EXPECT_TRUE(drawn.pictures[i].image.pixels == alone.pictures[i].image.pixels) << what;
  EXPECT_EQ(drawn.all_notes(), alone.all_notes()) << what;
  EXPECT_EQ(drawn.stats.particles, alone.stats.particles) << what;
  EXPECT_EQ(drawn.stats.drawn_particles, alone.stats.drawn_particles) << what;
}

bool shows_something(const DrawnFrame& drawn) {
  for (const float value : drawn.pictures.front().image.pixels) {
    if (value > 0.01F && value != 1) return true;
  }
  return false;
}

void expect_bits_of_one_process(const Arrays& arrays, const std::string& scene) {
  const DrawnFrame alone = draw_alone(arrays, scene);
  EXPECT_TRUE(shows_something(alone)) << scene;
  for (int ranks = 1; ranks <= 3; ++ranks) {
    for (const DrawnFrame& drawn : draw_spread(arrays, uneven(ranks), scene))
      expect_same(drawn, alone, std::to_string(ranks) + " ranks: " + scene);
  }
}

Arrays few() {
  return gas_and_stars(6000, 2000);
}

TEST(SpreadPictures, HaveTheBitsOfOneProcessInEachPlan) {
  expect_bits_of_one_process(few(), scene_head + outside + emission);
  expect_bits_of_one_process(few(), scene_head + outside + gas_of_picture);
  expect_bits_of_one_process(few(), scene_head + outside + ordered);
}

TEST(SpreadPictures, ChooseTheCameraOfAllParticles) {
  expect_bits_of_one_process(few(), scene_head + ordered);
}

TEST(SpreadPictures, TakeRangesFromAllParticles) {
  expect_bits_of_one_process(few(), scene_head + outside +
                                        "[[component]]\nname = \"gas\"\ntypes = \"gas\"\n"
                                        "color = { field = \"density\", percentiles = [0, 100] }\n"
                                        "intensity = { field = \"mass\" }\n"
                                        "palette = \"temperature\"\n");
}

TEST(SpreadPictures, ExposeForTheLightOfAllParticles) {
  expect_bits_of_one_process(
      few(),
      scene_head + outside + "[finish]\nexposure = \"auto\"\ntone = \"filmic\"\n" + gas_of_picture);
}

TEST(SpreadPictures, JoinTypesOneAfterTheOther) {
  expect_bits_of_one_process(few(), scene_head + outside +
                                        "[[component]]\nname = \"all\"\n"
                                        "types = [\"gas\", \"stars\"]\npalette = \"white\"\n"
                                        "absorption = 0.3\ncolor = { field = \"speed\" }\n");
}

TEST(SpreadPictures, SelectOfAllParticles) {
  expect_bits_of_one_process(
      few(), scene_head + outside + ordered +
                 "select = { where = \"density > 50\", sphere = { center = [0.1, 0, 0], "
                 "radius = 0.4 } }\n");
}

TEST(SpreadPictures, SelectNothing) {
  const std::string nothing = scene_head + outside + gas_of_picture + stars_of_picture +
                              "select = { where = \"density > 1e9\" }\n";
  expect_bits_of_one_process(few(), nothing);
}

TEST(SpreadPictures, SeeCloudsAroundTheCamera) {
  expect_bits_of_one_process(few(), scene_head + inside + emission);
  expect_bits_of_one_process(few(), scene_head + inside + ordered);
}

TEST(SpreadPictures, AreSortedByAField) {
  expect_bits_of_one_process(few(), scene_head + outside + "[sort]\nby = \"mass\"\n" + ordered);
}

TEST(SpreadPictures, MayBeMostExact) {
  expect_bits_of_one_process(gas_and_stars(600, 300),
                             "tolerance = 0\n" + scene_head + outside + ordered);
}

TEST(SpreadPictures, HaveSeveralViews) {
  expect_bits_of_one_process(
      few(), scene_head + outside + "[stereo]\nlayout = \"side_by_side\"\n" + ordered);
}

TEST(SpreadPictures, FindSizesFromDensities) {
  Arrays arrays = few();
  for (auto& [type, of_type] : arrays)
    of_type.scalars.erase("smoothing_length");
  expect_bits_of_one_process(arrays, scene_head + outside + ordered);
}

// As in one process, which notes it.
TEST(SpreadPictures, FindSizesFromNeighboursOnAllRanks) {
  Arrays arrays = gas_and_stars(12000, 2000);
  for (auto& [type, of_type] : arrays) {
    of_type.scalars.erase("smoothing_length");
    of_type.scalars.erase("density");
  }
  expect_bits_of_one_process(arrays, scene_head + outside + ordered);
  arrays[stars].vectors["position"][5] = std::numeric_limits<float>::infinity();
  expect_bits_of_one_process(arrays, scene_head + outside + gas_of_picture + stars_of_picture);
}

TEST(SpreadPictures, LeaveBadParticlesOutOnAllRanks) {
  Arrays arrays = few();
  for (const std::size_t i : {std::size_t{3}, std::size_t{5999}})
    arrays[gas].vectors["position"][3 * i] = std::numeric_limits<float>::quiet_NaN();
  arrays[stars].scalars["smoothing_length"][7] = 0;
  expect_bits_of_one_process(arrays, scene_head + outside + ordered);
}

TEST(SpreadPictures, WrapAroundTheBox) {
  const Arrays arrays = few();
  const std::string scene = scene_head + outside + "[periodic]\nwrap = true\nbox = 1.5\n" +
                            gas_of_picture + stars_of_picture;
  expect_bits_of_one_process(arrays, scene);
}

// A simulation moves its particles from rank to rank between two pictures.
TEST(SpreadPictures, FollowParticlesThatChangeTheirRank) {
  const Arrays arrays = few();
  const std::string text = scene_head + outside + ordered;
  const DrawnFrame alone = draw_alone(arrays, text);
  ThreadRanks::run(2, [&](Communicator& ranks) {
    ArraySnapshot own;
    Arrays part = part_of_rank(arrays, uneven(2), ranks.rank());
    set_fields(part, own);
    FrameDrawerOptions options;
    options.ranks = borrowed(ranks);
    FrameDrawer drawer(options);
    SpreadSnapshot all(own, options.ranks);
    const Scene scene = parse_scene(text, "scene");
    expect_same(drawer.draw(scene, all), alone, "before");
    part = part_of_rank(arrays, {{{gas, 1}, {stars, 0.2}}, {{gas, 1}, {stars, 1}}}, ranks.rank());
    own.clear(gas);
    own.clear(stars);
    set_fields(part, own);
    all.changed();
    expect_same(drawer.draw(scene, all), alone, "after");
  });
}

// What the first picture decides holds for the others.
TEST(SpreadPictures, AreDrawnOfASceneThatWasDecidedTogether) {
  const Arrays arrays = few();
  const std::string text = scene_head + ordered;
  ArraySnapshot whole;
  set_fields(arrays, whole);
  std::vector<std::string> notes;
  const std::string alone =
      format_scene(fixed_scene(decide(parse_scene(text, "scene"), whole, notes)));
  ThreadRanks::run(3, [&](Communicator& ranks) {
    const RankOfSimulation own(arrays, uneven(3), ranks);
    std::vector<std::string> own_notes;
    EXPECT_EQ(format_scene(fixed_scene(decide(parse_scene(text, "scene"), own.all, own_notes))),
              alone);
  });
}

}  // namespace
}  // namespace splotchcl::test
