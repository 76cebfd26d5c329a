// What render draws, pixel by pixel, with trees and without; what it answers is told by sessions.
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "splotchcl/image_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// What render draws, pixel by pixel; what it answers is told by sessions.

class Render : public ::testing::Test {
 protected:
  void SetUp() override {
    SKIP_WITHOUT_DEVICE();
    std::filesystem::copy(made_once("generate universe --particles 20000"), folder_ / "u");
  }
  Image picture(const std::string& arguments) {
    const ProgramResult result = splotchcl_in(folder_, "render u " + arguments + " -o a.exr");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return read_image(folder_ / "a.exr");
  }
  TemporaryFolder folder_;
};

TEST_F(Render, DrawsACropAsThatPartOfThePicture) {
  const Image whole = picture("--size 160x120"),
              part = picture("--size 160x120 --crop 37,21,70,50");
  ASSERT_EQ(part.width, 70);
  ASSERT_EQ(part.height, 50);
  // Tiles and grids may start elsewhere, so each may use up the tolerance: twice 1e-3.
  for (int y = 0; y < part.height; ++y) {
    for (int x = 0; x < part.width; ++x) {
      for (int c = 0; c < 4; ++c)
        EXPECT_NEAR(part.at(x, y)[c], whole.at(x + 37, y + 21)[c], 2e-3) << x << "," << y;
    }
  }
}

TEST_F(Render, WritesABoundOfEachPixelThatNoneExceeds) {
  const Image drawn = picture("--size 80x60 --error-map map.exr"),
              exact = picture("--size 80x60 --reference"), map = read_image(folder_ / "map.exr");
  ASSERT_EQ(map.pixels.size(), drawn.pixels.size());
  for (std::size_t i = 0; i < drawn.pixels.size(); ++i) {
    if (i % 4 == 3) continue;
    const float allowed = std::max(1.0f, std::abs(exact.pixels[i])) * map.pixels[i];
    ASSERT_LE(std::abs(drawn.pixels[i] - exact.pixels[i]), allowed);
    ASSERT_LE(map.pixels[i], 1e-3f);
  }
}

double mean_light(const Image& image) {
  double sum = 0;
  for (const float value : image.pixels)
    sum += static_cast<double>(value);
  return sum / static_cast<double>(image.pixels.size());
}

TEST_F(Render, DrawsAPartOfTheParticlesAsBrightAsAll) {
  const std::string all = "--size 128x128 --set component.0.absorption=none ";
  const double light = mean_light(picture(all));
  // The exposure is chosen anew from the particles that are left, which are noisier.
  for (const char* const option : {"--every 5", "--max-particles 4000"})
    EXPECT_NEAR(mean_light(picture(all + option)) / light, 1, 0.3) << option;
}

// Trees of merged particles, from the command that makes them to what is told of a picture.

class Trees : public ::testing::Test {
 protected:
  void SetUp() override {
    SKIP_WITHOUT_DEVICE();
    copy_into(folder_, folder_after("\"$splotchcl\" generate universe --particles 100000 -o u && "
                                    "\"$splotchcl\" tree u"));
  }
  ProgramResult render(const std::string& arguments) const {
    return splotchcl_in(folder_,
                        "render u --set kernel.footprint=0.5 --size 24x16 "
                        "--tolerance 0.02 -o u.png " +
                            arguments);
  }
  nlohmann::json stats() const {
    return nlohmann::json::parse(read_text(folder_ / "stats.json")).at("tree");
  }

  TemporaryFolder folder_;
};

TEST_F(Trees, TellNodesBytesTheEstimateAndWhatWasFound) {
  const ProgramResult drawn = render("--tree only --stats stats.json");
  ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
  const nlohmann::json tree = stats();
  ASSERT_FALSE(tree.is_null()) << drawn.err;
  EXPECT_GT(tree.at("nodes"), 100);
  EXPECT_LT(tree.at("nodes").get<int>() + tree.at("particles").get<int>(), 75000);
  EXPECT_GT(tree.at("bytes"), 20 * tree.at("visited").get<int>());
  EXPECT_GT(tree.at("estimate_of_promise"), 0.05);
  EXPECT_GT(tree.at("found_of_promise"), 0);
  EXPECT_LE(tree.at("found_of_promise"), 1);
}

TEST_F(Trees, AreExplainedWhereTheyAreUsed) {
  EXPECT_THAT(render("--tree only --explain").out,
              AllOf(HasSubstr("# tree: "), HasSubstr(" nodes and ")));
  EXPECT_THAT(render("--tree never --explain").out, Not(HasSubstr("# tree: ")));
  EXPECT_THAT(render("--tree only --explain --certify").out, Not(HasSubstr("# tree: ")));
}

TEST_F(Trees, AreNotUsedWhereTheSceneSaysNever) {
  ASSERT_EQ(render("--tree never --stats stats.json").exit_code, 0);
  EXPECT_TRUE(stats().is_null());
}

}  // namespace
}  // namespace splotchcl::test
