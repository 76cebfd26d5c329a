#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "cli/program.h"
#include "splotchcl/image_file.h"

namespace splotchcl::test {
namespace {

using ::testing::HasSubstr;

constexpr const char* scene_text = R"(
snapshot = "galaxy.hdf5"
[image]
size = [64, 48]
[camera]
position = [0, 0, 40]
look_at = [0, 0, 0]
field_of_view = 40
[[component]]
types = ["gas", "disk"]
color = { vector = "Color" }
)";

// A spot beside a disk tells how far it has turned.
void draw_galaxy(const std::filesystem::path& path) {
  Image image(96, 96);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float radius = std::hypot(static_cast<float>(x - 48), static_cast<float>(y - 48));
      const bool is_spot = std::abs(x - 68) < 4 && std::abs(y - 48) < 4;
      for (int i = 0; i < 3; ++i)
        image.at(x, y)[i] = (is_spot && i == 2 ? 1.0F : 0.5F) * std::exp(-radius / 10);
    }
  }
  write_image(path, image);
}

class Evolve : public ::testing::Test {
 protected:
  void SetUp() override {
    SKIP_WITHOUT_DEVICE();
    draw_galaxy(folder_ / "galaxy.png");
    std::ofstream(folder_ / "scene.toml") << scene_text;
    const auto made = splotchcl_in(folder_,
                                   "galaxy galaxy.png -o galaxy.hdf5 --gamma 1 --disk-stars 2000 "
                                   "--bulge-stars 1000 --clusters 5 --cluster-stars 50");
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }
  TemporaryFolder folder_;
};

TEST_F(Evolve, DrawsNumberedFramesAndWritesSnapshots) {
  const auto result = splotchcl_in(folder_,
                                   "evolve galaxy.hdf5 scene.toml -o t_%02d.png --snapshots "
                                   "s_%d.hdf5 --frames 3 --duration 60");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* const name : {"t_00.png", "t_02.png", "s_0.hdf5", "s_2.hdf5"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / name)) << name;
  EXPECT_NE(read_text(folder_ / "t_00.png"), read_text(folder_ / "t_02.png"));
  EXPECT_THAT(splotchcl_in(folder_, "info s_2.hdf5").out, HasSubstr("60"));
}

TEST_F(Evolve, PartsMakeTheSameFramesAsOneProcess) {
  const std::string command = "evolve galaxy.hdf5 scene.toml --frames 3 --duration 60 ";
  ASSERT_EQ(splotchcl_in(folder_, command + "-o all_%d.png").exit_code, 0);
  ASSERT_EQ(splotchcl_in(folder_, command + "-o part_%d.png --part 2/2").exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "part_0.png"));
  EXPECT_EQ(read_text(folder_ / "part_2.png"), read_text(folder_ / "all_2.png"));
}

// A halo, two of whose particles have no place, around the galaxy.
TEST_F(Evolve, CountsBadParticlesInOneNote) {
  ASSERT_EQ(splotchcl_in(folder_, "generate halo --particles 1000 -o halo.gadget").exit_code, 0);
  {
    // The first of the positions: after HEAD (16 + 264) and the label of POS (16 + 4).
    std::fstream file(folder_ / "halo.gadget", std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(16 + 264 + 16 + 4);
    const float bad[6] = {std::numeric_limits<float>::quiet_NaN(), 0, 0, 0, 0,
                          std::numeric_limits<float>::infinity()};
    file.write(reinterpret_cast<const char*>(bad), sizeof bad);
  }
  std::ofstream(folder_ / "both.toml")
      << "snapshot = 'halo.gadget'\n[image]\nsize = [32, 24]\n"
         "[camera]\nposition = [0, 0, 400]\nlook_at = [0, 0, 0]\n"
         "[[component]]\nname = 'gas'\npalette = 'white'\n"
         "[[component]]\nsnapshot = 'galaxy.hdf5'\ncolor = { vector = 'Color' }\n";
  const auto result =
      splotchcl_in(folder_, "evolve galaxy.hdf5 both.toml -o t_%d.png --frames 3 --duration 60");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
  EXPECT_THAT(result.err, HasSubstr("2 of "));
  EXPECT_THAT(result.err, HasSubstr("particles are left out"));
}

TEST_F(Evolve, TruncatesAsTheOriginalDoesWhereTheSceneAsksForIt) {
  const std::string command =
      "evolve galaxy.hdf5 scene.toml --frames 1 --set image.convention=original -o original_%d.";
  ASSERT_EQ(splotchcl_in(folder_, command + "png").exit_code, 0);
  ASSERT_EQ(splotchcl_in(folder_, command + "exr").exit_code, 0);
  const Image bytes = read_image(folder_ / "original_0.png");
  const Image light = read_image(folder_ / "original_0.exr");
  ASSERT_EQ(bytes.pixels.size(), light.pixels.size());
  for (std::size_t i = 0; i < light.pixels.size(); ++i) {
    if (i % 4 == 3) continue;
    const float truncated = std::floor(256 * std::clamp(light.pixels[i], 0.0F, 1.0F));
    EXPECT_EQ(std::lround(255 * bytes.pixels[i]), std::lround(std::min(truncated, 255.0F)));
  }
}

TEST_F(Evolve, WarnsOfWinding) {
  const auto result =
      splotchcl_in(folder_, "evolve galaxy.hdf5 --snapshots s_%d.hdf5 --frames 1 --duration 2000");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("wind up"));
  EXPECT_TRUE(is_one_line(result.err));
}

TEST_F(Evolve, LastsAsLongAsTheArmsHold) {
  const auto result =
      splotchcl_in(folder_, "evolve galaxy.hdf5 --snapshots s_%d.hdf5 --frames 1 --core 0.1");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  const double hold = [&] {
    const std::string info = splotchcl_in(folder_, "info s_0.hdf5 --json").out;
    const auto at = info.find("\"time\":");
    return at == std::string::npos ? 0 : std::stod(info.substr(at + 7));
  }();
  // Half of the disk's light lies within 3 to 6 kpc: 10 pixels of 30 / 96 kpc are the scale.
  const double per_kpc = 978 / 200.0 / std::tan(20 * M_PI / 180);
  EXPECT_GT(hold, 3 * per_kpc);
  EXPECT_LT(hold, 6 * per_kpc);
}

TEST_F(Evolve, APatternEndsAsItBegan) {
  const auto result = splotchcl_in(
      folder_, "evolve galaxy.hdf5 scene.toml -o p_%d.exr --frames 3 --pattern-speed 40");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const Image first = read_image(folder_ / "p_0.exr"), half = read_image(folder_ / "p_1.exr"),
              last = read_image(folder_ / "p_2.exr");
  double back = 0, moved = 0;
  for (std::size_t i = 0; i < first.pixels.size(); ++i) {
    back = std::max(back, std::abs(static_cast<double>(last.pixels[i] - first.pixels[i])));
    moved = std::max(moved, std::abs(static_cast<double>(half.pixels[i] - first.pixels[i])));
  }
  EXPECT_LT(back, 0.01 * moved);
}

TEST_F(Evolve, WrongCallsAreRefusedBeforeAnythingIsMade) {
  const std::size_t files = folder_.count_files();
  const auto refuses = [&](const std::string& arguments, const std::string& text) {
    const auto result = splotchcl_in(folder_, "evolve galaxy.hdf5 " + arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_THAT(result.err, HasSubstr(text));
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
  };
  refuses("", "nothing to make");
  refuses("-o t_%d.png", "without a SCENE");
  refuses("scene.toml -o t.png", "expected a name with one place for a number");
  refuses("scene.toml -o t_%d.png --part 3/2", "expected K/N");
  refuses("scene.toml -o t_%d.png --frames 0", "expected 1 to");
  refuses("scene.toml -o t_%d.png --step 3", "only --first-order");
  refuses("scene.toml -o t_%d.png --duration -5", "expected 0 to");
  refuses("scene.toml -o t_%d.png --pattern-speed -40", "pattern's speed is -40");
  EXPECT_EQ(folder_.count_files(), files);
}

TEST_F(Evolve, OtherSnapshotsAreRefused) {
  ASSERT_EQ(splotchcl_in(folder_, "generate halo --particles 1000 -o halo.gadget").exit_code, 0);
  const auto result = splotchcl_in(folder_, "evolve halo.gadget --snapshots s_%d.hdf5 --frames 1");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("make one with splotchcl galaxy"));
}

}  // namespace
}  // namespace splotchcl::test
