#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "splotchcl/image_file.h"

namespace splotchcl::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// A small universe, 3400 gas and 600 star particles.
class Render : public ::testing::Test {
 protected:
  void SetUp() override {
    SKIP_WITHOUT_DEVICE();
    ASSERT_EQ(splotchcl_in(folder_, "generate universe -o u --particles 4000").exit_code, 0);
  }
  ProgramResult render(const std::string& arguments) {
    return splotchcl_in(folder_, "render " + arguments);
  }
  // Of a call that must succeed.
  Image picture(const std::string& arguments) {
    const ProgramResult result = render(arguments + " -o picture.exr");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return read_image(folder_ / "picture.exr");
  }
  void expect_wrong_call(const std::string& arguments, const std::string& part_of_message) {
    const ProgramResult result = render(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_THAT(result.err, AllOf(StartsWith("splotchcl: "), HasSubstr(part_of_message)));
  }
  TemporaryFolder folder_;
};

constexpr const char* small = " --set 'image.size=[80,60]'";

TEST_F(Render, ExplainsThePlanAndTheSceneWithoutDrawing) {
  const ProgramResult result = render("u --explain");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, AllOf(StartsWith("# plan: "), HasSubstr("[[component]]")));
  EXPECT_EQ(folder_.count_files(), 1U);  // the snapshot
}

TEST_F(Render, ExplainsAndDrawsWithAnOutput) {
  const ProgramResult result = render(std::string("u --explain -o a.png") + small);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, StartsWith("# plan: "));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "a.png"));
}

TEST_F(Render, NamesThePictureAfterTheSceneByDefault) {
  ASSERT_EQ(run_in(folder_, "mkdir set && mv u set/snap_1.gadget").exit_code, 0);
  for (const std::string scene : {"set/snap_1.gadget", "set", "set/", "set/."}) {
    EXPECT_EQ(render(scene + small).exit_code, 0) << scene;
    const char* const name = scene == "set/snap_1.gadget" ? "snap_1.png" : "set.png";
    EXPECT_TRUE(std::filesystem::remove(folder_ / name)) << scene;
  }
}

TEST_F(Render, DrawsTheSamePictureFromTheSceneThatIsExplained) {
  ASSERT_EQ(render(std::string("u --explain > scene.toml") + small).exit_code, 0);
  EXPECT_EQ(picture("scene.toml").pixels, picture(std::string("u") + small).pixels);
}

TEST_F(Render, TakesASceneFileOfAnyName) {
  ASSERT_EQ(render(std::string("u --explain > scene") + small).exit_code, 0);
  EXPECT_EQ(picture("scene").width, 80);
}

TEST_F(Render, OverridesKeysOfTheScene) {
  const Image image = picture("u --set 'image.size=[31,17]' --set image.gamma=2");
  EXPECT_EQ(image.width, 31);
  EXPECT_EQ(image.height, 17);
}

TEST_F(Render, NamesTheSceneThatHasNoComponent) {
  std::ofstream(folder_ / "empty.toml") << "snapshot = 'u'\n";
  expect_wrong_call("empty.toml", "empty.toml: found no component");
}

TEST_F(Render, LooksAlongTheSkyThatWasChosen) {
  const std::string above = "u --set camera.look_at=[0,0,0] --set camera.position=[0,0,9e4]";
  EXPECT_EQ(render(above + small).exit_code, 0);
}

TEST_F(Render, SuggestsTheKeyThatWasMeant) {
  expect_wrong_call("u --set image.gama=2", "gamma");
}

TEST_F(Render, RefusesAToleranceBelowZero) {
  expect_wrong_call("u --tolerance=-1", "tolerance");
}

TEST_F(Render, RefusesADeviceThatDoesNotExist) {
  expect_wrong_call(std::string("u --device abacus") + small, "abacus");
}

TEST_F(Render, RefusesAShapeThatDoesNotExist) {
  expect_wrong_call(std::string("u --shape triangles") + small,
                    "found triangles, expected automatic, rows or groups");
}

TEST_F(Render, DrawsAlikeInBothShapes) {
  ASSERT_EQ(render(std::string("u -o rows.exr --shape rows") + small).exit_code, 0);
  ASSERT_EQ(render(std::string("u -o groups.exr --shape Groups") + small).exit_code, 0);
  const Image rows = read_image(folder_ / "rows.exr"), groups = read_image(folder_ / "groups.exr");
  ASSERT_EQ(rows.pixels.size(), groups.pixels.size());
  EXPECT_NE(rows.pixels, groups.pixels) << "they are different kernels";
  for (std::size_t i = 0; i < rows.pixels.size(); ++i)
    ASSERT_NEAR(rows.pixels[i], groups.pixels[i], 2e-3f * std::max(1.0f, std::abs(rows.pixels[i])));
}

TEST_F(Render, RefusesACropOutsideThePicture) {
  for (const char* crop :
       {"0,0,81,10", "70,0,20,10", "-1,0,5,5", "0,0,0,5", "2147483647,0,2147483647,1"}) {
    expect_wrong_call(std::string("u --crop=") + crop + small, "80x60");
  }
}

TEST_F(Render, DrawsACropAsThatPartOfThePicture) {
  const Image whole = picture(std::string("u --set 'image.size=[160,120]'"));
  const Image part = picture(std::string("u --set 'image.size=[160,120]' --crop 37,21,70,50"));
  ASSERT_EQ(part.width, 70);
  ASSERT_EQ(part.height, 50);
  // Tiles and grids may start elsewhere, so each may use up the tolerance: twice 1e-3.
  for (int y = 0; y < part.height; ++y) {
    for (int x = 0; x < part.width; ++x) {
      for (int c = 0; c < 4; ++c) {
        EXPECT_NEAR(part.at(x, y)[c], whole.at(x + 37, y + 21)[c], 2e-3) << x << "," << y;
      }
    }
  }
}

TEST_F(Render, NamesWhatAParameterFileOfTheOriginalLacks) {
  std::ofstream(folder_ / "old.par") << "infile=u\n";
  expect_wrong_call("old.par", "old.par: key palette0");
}

// From another folder, too.
TEST_F(Render, DrawsTheSamePictureFromAParameterFileAndTheSceneItBecomes) {
  ASSERT_EQ(splotchcl_in(folder_, "generate halo -o snap_007 --particles 1000").exit_code, 0);
  std::ofstream(folder_ / "old.pal") << "old\n0100\n3\n0 0 99\n200 50 10\n255 255 255\n";
  std::ofstream(folder_ / "old.par")
      << "infile=snap_\nfidx=7\nperiodic=F\nptypes=1\nptype0=0\nsize_label0=HSML\n"
         "size_fac0=0.5\ncolor_label0=U\npalette0=old.pal\nbrightness0=30\na_eq_e=F\n"
         "gray_absorption=0.01\nxres=40\nyres=30\nfov=30\ncamera_x=90\ncamera_y=5\n"
         "camera_z=10\nlookat_x=0\nlookat_y=0\nlookat_z=0\nEyeSeparation=2\npic_gamma=0.7\n"
         "pic_contrast=1.5\n";
  std::filesystem::create_directory(folder_ / "scenes");
  const std::string draw = " --reference -o ";
  ASSERT_EQ(splotchcl_in(folder_, "render old.par" + draw + "a.png").exit_code, 0);
  ASSERT_EQ(splotchcl_in(folder_, "convert old.par -o scenes/new.toml").exit_code, 0);
  const ProgramResult result = splotchcl_in(folder_, "render scenes/new.toml" + draw + "b.png");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const std::string eye : {"_left.png", "_right.png"}) {
    const Image image = read_image(folder_ / ("a" + eye));
    EXPECT_EQ(image.pixels, read_image(folder_ / ("b" + eye)).pixels);
    EXPECT_GT(image.at(20, 15)[0], 0.1F);
  }
}

TEST_F(Render, NamesFileAndLineOfAWrongScene) {
  std::ofstream(folder_ / "scene.toml") << "snapshot = \"u\"\n\n[image]\nsize = \"large\"\n";
  expect_wrong_call("scene.toml", "scene.toml:4");
}

TEST_F(Render, CountsBadParticlesInOneNote) {
  {
    // The first of the positions: after HEAD (16 + 264) and the label of POS (16 + 4).
    std::fstream file(folder_ / "u", std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(16 + 264 + 16 + 4);
    const float bad[6] = {std::numeric_limits<float>::quiet_NaN(), 0, 0, 0,
                          std::numeric_limits<float>::infinity(),  0};
    file.write(reinterpret_cast<const char*>(bad), sizeof bad);
  }
  for (const std::string renderer : {"", " --reference"}) {
    const ProgramResult result = render("u -o a.png" + renderer + small);
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_THAT(result.err, HasSubstr("2 of 4000 particles are left out"));
  }
}

TEST_F(Render, TellsTimesAndCountsAsJson) {
  ASSERT_EQ(render(std::string("u -o a.png --stats s.json --crop 8,8,32,16") + small).exit_code, 0);
  const auto json = nlohmann::json::parse(read_text(folder_ / "s.json"));
  EXPECT_EQ(json["output"], "a.png");
  EXPECT_EQ(json["particles"]["total"], 4000);
  EXPECT_EQ(json["tolerance"], 1e-3);
  EXPECT_EQ(json["plan"]["light"], "emission");
  EXPECT_EQ(json["crop"], nlohmann::json({8, 8, 32, 16}));
  EXPECT_GT(json["seconds"]["draw"], 0);
  EXPECT_FALSE(json["stages"].empty());
}

TEST_F(Render, SaysHowWellThePromiseIsKept) {
  ASSERT_EQ(render(std::string("u -o a.png --stats s.json") + small).exit_code, 0);
  const auto check = nlohmann::json::parse(read_text(folder_ / "s.json"))["check"];
  EXPECT_EQ(check["is_bound"], false);
  EXPECT_LE(check["errors_of_promise"].back(), 1);
}

TEST_F(Render, SaysThatStarsWereTooSharpForSinglePrecision) {
  std::ofstream(folder_ / "stars.csv") << "x,y,z\n0.0101,0.0132,0\n0.5,0.3,0\n";
  std::ofstream(folder_ / "stars.toml") << R"(snapshot = "stars.csv"
[image]
size = [40, 30]
[camera]
position = [0, 0, -5]
look_at = [0, 0, 0]
[[component]]
types = "gas"
size = { fixed = 1e-3 }
palette = "white"
weight = "constant"
absorption = "none"
brightness = 1e6
)";
  for (const auto& [tolerance, is_said] : {std::pair("1e-3", false), std::pair("1e-5", true)}) {
    ASSERT_EQ(render(std::string("stars.toml -o a.png --stats s.json --tolerance ") + tolerance)
                  .exit_code,
              0);
    EXPECT_EQ(nlohmann::json::parse(read_text(folder_ / "s.json"))["drawn_most_exactly"], is_said);
  }
}

TEST_F(Render, CertifiesThatThePromiseIsKept) {
  ASSERT_EQ(render(std::string("u -o a.png --certify --stats s.json") + small).exit_code, 0);
  const auto check = nlohmann::json::parse(read_text(folder_ / "s.json"))["check"];
  EXPECT_EQ(check["is_bound"], true);
  EXPECT_LE(check["errors_of_promise"].back(), 1);
}

TEST_F(Render, WritesABoundOfEachPixelThatNoneExceeds) {
  ASSERT_EQ(render(std::string("u -o a.exr --error-map map.exr") + small).exit_code, 0);
  ASSERT_EQ(render(std::string("u -o exact.exr --reference") + small).exit_code, 0);
  const Image drawn = read_image(folder_ / "a.exr"), exact = read_image(folder_ / "exact.exr"),
              map = read_image(folder_ / "map.exr");
  ASSERT_EQ(map.pixels.size(), drawn.pixels.size());
  for (std::size_t i = 0; i < drawn.pixels.size(); ++i) {
    if (i % 4 == 3) continue;
    const float allowed = std::max(1.0f, std::abs(exact.pixels[i])) * map.pixels[i];
    ASSERT_LE(std::abs(drawn.pixels[i] - exact.pixels[i]), allowed);
    ASSERT_LE(map.pixels[i], 1e-3f);
  }
}

TEST_F(Render, RefusesAMapOfErrorsOfTheReference) {
  const ProgramResult result =
      render(std::string("u -o a.exr --reference --error-map map.exr") + small);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.exr"));
}

TEST_F(Render, DrawsWithTheReferenceTheSamePictureWithinTheTolerance) {
  for (const std::string absorption : {"emission", "none", "0.5"}) {
    SCOPED_TRACE(absorption);
    const std::string scene = std::string("u") + small +
                              " --set finish.tone=linear --set finish.exposure=0"
                              " --set finish.white=1 --set component.gas.absorption=" +
                              absorption + " --set component.stars.absorption=" + absorption;
    ASSERT_EQ(render(scene + " -o device.exr").exit_code, 0);
    ASSERT_EQ(render(scene + " --reference -o reference.exr").exit_code, 0);
    const ProgramResult result =
        splotchcl_in(folder_, "compare device.exr reference.exr --limit 1e-3");
    EXPECT_EQ(result.exit_code, 0) << result.out;
  }
}

}  // namespace
}  // namespace splotchcl::test
