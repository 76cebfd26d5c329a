// The scene that `splotchcl galaxy` writes, from all sides.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "cli/program.h"
#include "galaxy/galaxy_picture.h"
#include "splotchcl/image_file.h"

namespace splotchcl::test {
namespace {

using ::testing::HasSubstr;

class GalaxyScene : public ::testing::Test {
 protected:
  void SetUp() override {
    SKIP_WITHOUT_DEVICE();
    write_image(folder_ / "spiral.exr", SpiralPicture().draw());
    std::filesystem::create_directory(folder_ / "scenes");
    const auto made = splotchcl_in(folder_,
                                   "galaxy spiral.exr -o m.hdf5 --scene scenes/m.toml --size 16 "
                                   "--disk-stars 20000 --bulge-stars 10000");
    ASSERT_EQ(made.exit_code, 0) << made.err;
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

TEST_F(GalaxyScene, WhatIsSuggestedHasTheDust) {
  const auto explained = splotchcl_in(folder_, "render m.hdf5 --explain");
  ASSERT_EQ(explained.exit_code, 0) << explained.err;
  EXPECT_THAT(explained.out, HasSubstr("name = \"dust\""));
  EXPECT_THAT(explained.out, HasSubstr("vector = \"Opacity\""));
  EXPECT_EQ(explained.err, "");
  EXPECT_LE(clipped_part(draw(90, "m.hdf5")), 0.01);
}

TEST_F(GalaxyScene, IsNoneOfTheInputs) {
  const auto refused = splotchcl_in(folder_, "galaxy spiral.exr -o x.hdf5 --scene spiral.exr");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--scene"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "x.hdf5"));
}

}  // namespace
}  // namespace splotchcl::test
