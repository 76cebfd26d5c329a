// The scene that `splotchcl galaxy` writes, from all sides, and what evolve makes of galaxies.
#include "cli/lit_pictures.h"
#include "cli/program.h"
#include "damaged_hdf5.h"
#include "galaxy/galaxy_picture.h"
#include "splotchcl/image_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

class GalaxyScene : public ::testing::Test {
 protected:
  void SetUp() override {
    SKIP_WITHOUT_DEVICE();
    const std::string spiral = folder_ / "spiral.exr";
    write_image(spiral, SpiralPicture().draw());
    copy_into(folder_, galaxy_of(spiral));
  }

  // Made once, of the picture that each test has.
  static const TemporaryFolder& galaxy_of(const std::string& picture) {
    static const TemporaryFolder& made = folder_after(
        "mkdir scenes && \"$splotchcl\" galaxy '" + picture +
        "' -o m.hdf5 --scene scenes/m.toml --size 16 --disk-stars 20000 --bulge-stars 10000");
    return made;
  }

  // Tilted by so many degrees: 0 is face-on.
  Image draw(double degrees, const std::string& scene = "scenes/m.toml") {
    const double tilt = degrees * M_PI / 180;
    std::ostringstream command;
    command << "render " << scene
            << " -o m.png --set image.size=[320,180] --set camera.position=[0,"
            << -22 * std::sin(tilt) << ',' << 22 * std::cos(tilt)
            << "] --set camera.sky=" << (degrees > 45 ? "[0,0,1]" : "[0,1,0]");
    const auto drawn = splotchcl_in(folder_, command.str());
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
    return read_image(folder_ / "m.png");
  }

  TemporaryFolder folder_;
};

// Of all pixels, those with a channel at the display's limit.
double clipped_part(const Image& image) {
  int clipped = 0;
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    if (std::max({image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]}) >= 1) ++clipped;
  }
  return clipped / (static_cast<double>(image.pixels.size()) / 4);
}

double brightest(const Image& image) {
  float most = 0;
  for (std::size_t i = 0; i < image.pixels.size(); i += 4)
    most = std::max(most, image.pixels[i + 1]);
  return static_cast<double>(most);
}

TEST_F(GalaxyScene, HoldsAtEveryInclination) {
  for (const double degrees : {0.0, 30.0, 60.0, 80.0, 90.0}) {
    const Image image = draw(degrees);
    EXPECT_LE(clipped_part(image), 0.01) << degrees;
    EXPECT_GT(brightest(image), 0.5) << degrees;
  }
}

TEST_F(GalaxyScene, IsLitAllAlongWhereItTurns) {
  const auto turned = splotchcl_in(
      folder_, "evolve m.hdf5 scenes/m.toml --frames 10 -o t_%d.png --set image.size=[160,90]");
  ASSERT_EQ(turned.exit_code, 0) << turned.err;
  for (int i = 0; i < 10; ++i)
    expect_lit(read_image(folder_ / ("t_" + std::to_string(i) + ".png")), i);
}

TEST_F(GalaxyScene, WhatIsSuggestedHasTheDust) {
  const auto explained = splotchcl_in(folder_, "render m.hdf5 --explain");
  ASSERT_EQ(explained.exit_code, 0) << explained.err;
  EXPECT_THAT(explained.out, HasSubstr("name = \"dust\""));
  EXPECT_THAT(explained.out, HasSubstr("vector = \"Opacity\""));
  EXPECT_EQ(explained.err, "");
  EXPECT_LE(clipped_part(draw(90, "m.hdf5")), 0.01);
}

TEST_F(GalaxyScene, IsTruncatedAsInTheOriginalWhereItAsksForIt) {
  const std::string command =
      "evolve m.hdf5 scenes/m.toml --frames 1 --set image.size=[64,48] --set image.gamma=1 "
      "--set finish.tone=linear --set finish.exposure=0 --set finish.white=1 "
      "--set image.convention=original -o o_%d.";
  ASSERT_EQ(splotchcl_in(folder_, command + "png").exit_code, 0);
  ASSERT_EQ(splotchcl_in(folder_, command + "exr").exit_code, 0);
  const Image bytes = read_image(folder_ / "o_0.png");
  const Image light = read_image(folder_ / "o_0.exr");
  ASSERT_EQ(bytes.pixels.size(), light.pixels.size());
  for (std::size_t i = 0; i < light.pixels.size(); ++i) {
    if (i % 4 == 3) continue;
    const float truncated = std::floor(256 * std::clamp(light.pixels[i], 0.0F, 1.0F));
    EXPECT_EQ(std::lround(255 * bytes.pixels[i]), std::lround(std::min(truncated, 255.0F)));
  }
}

// HDF5 may crash on it, or speak of it when the program ends, as it does for two of these.
TEST(OddFiles, OfDamagedHdf5AreOneLineInEvolveToo) {
  const TemporaryFolder folder;
  const auto run = [&folder](const std::string& arguments) {
    return splotchcl_in(folder, arguments);
  };
  const std::string options = " --disk-stars 50 --bulge-stars 50 --clusters 1 --cluster-stars 10";
  Image spot(32, 32);
  for (int i = 0; i < 3; ++i)
    spot.at(16, 16)[i] = 1;
  write_image(folder / "spot.exr", spot);
  ASSERT_EQ(run("galaxy spot.exr -o g.hdf5" + options).exit_code, 0);
  DamagedHdf5 damaged(read_text(folder / "g.hdf5"), 3);
  for (int i = 0; i < 60; ++i) {
    std::ofstream(folder / "damaged.hdf5", std::ios::binary) << damaged.next();
    const ProgramResult result = run("evolve damaged.hdf5 --snapshots s_%d.hdf5 --frames 1");
    EXPECT_LE(result.exit_code, 2) << i;
    if (result.exit_code == 0) continue;
    EXPECT_TRUE(is_one_line(result.err)) << i << "\n" << result.err.substr(0, 1000);
  }
}

}  // namespace
}  // namespace splotchcl::test
