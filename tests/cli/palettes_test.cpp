#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "splotchcl/image_file.h"
#include "splotchcl/palette.h"

namespace splotchcl::test {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

// Whether some pixel of the picture is this colour, to 8 bits.
bool shows(const Image& image, const Rgb& color) {
  for (std::size_t pixel = 0; pixel < image.pixels.size(); pixel += 4) {
    bool is_equal = true;
    for (std::size_t c = 0; c < 3; ++c)
      is_equal = is_equal && std::abs(image.pixels[pixel + c] - color[c]) < 0.003F;
    if (is_equal) return true;
  }
  return false;
}

TEST(Palettes, AreListedWithTheirColors) {
  const TemporaryFolder folder;
  const ProgramResult result = splotchcl_in(folder, "palettes");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(ContainsRegex("turbo +51  violet, blue"), HasSubstr("\nRdBu "),
                                HasSubstr("\nveil "), HasSubstr("\nviridis ")));
}

TEST(Palettes, OfTheUsersFolderAreListedWithTheirFiles) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_in(folder,
             "mkdir own; echo '1 0 0' > own/mine.txt; echo x > own/bad.txt; "
             "SPLOTCHCL_PALETTES=own \"$splotchcl\" palettes");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(ContainsRegex("mine +1  own/mine.txt"), HasSubstr("\nmagma "),
                                Not(HasSubstr("bad"))));
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
  EXPECT_THAT(result.err, HasSubstr("own/bad.txt:1: found \"x\""));
}

TEST(Palettes, AreListedForPrograms) {
  const TemporaryFolder folder;
  const auto json = nlohmann::json::parse(splotchcl_in(folder, "palettes veil gray_r --json").out);
  ASSERT_EQ(json.size(), 2U);
  EXPECT_EQ(json[0]["name"], "veil");
  EXPECT_EQ(json[0]["has_own_absorption"], true);
  EXPECT_EQ(json[1]["name"], "gray_r");
  EXPECT_EQ(json[1]["knots"], 2);
}

TEST(Palettes, AreShownInAPicture) {
  const TemporaryFolder folder;
  std::ofstream(folder / "mine.txt") << "0.9 0.1 0.5\n";
  const ProgramResult result =
      splotchcl_in(folder, "palettes seismic mine.txt --preview palettes.png");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Image picture = read_image(folder / "palettes.png");
  EXPECT_TRUE(shows(picture, {0, 0, 0.3F}));
  EXPECT_TRUE(shows(picture, {0.5F, 0, 0}));
  EXPECT_TRUE(shows(picture, {0.9F, 0.1F, 0.5F}));
}

TEST(Palettes, InOnePictureAreNoTallerThanWide) {
  const TemporaryFolder folder;
  ASSERT_EQ(splotchcl_in(folder, "palettes --preview all.png").exit_code, 0);
  const ImageFileInfo info = read_image_info(folder / "all.png");
  EXPECT_LE(info.height, info.width);
}

TEST(Palettes, ThatAreUnknownAreRefused) {
  const TemporaryFolder folder;
  const ProgramResult result = splotchcl_in(folder, "palettes infreno --preview p.png");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
  EXPECT_THAT(result.err, HasSubstr("did you mean inferno?"));
  EXPECT_EQ(folder.count_files(), 0U);
}

}  // namespace
}  // namespace splotchcl::test
