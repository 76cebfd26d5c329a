#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "splotchcl/image_file.h"

namespace splotchcl::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

Image filled(int width, int height, float value) {
  Image image(width, height);
  for (float& v : image.pixels)
    v = value;
  return image;
}

TEST(Compare, EndsWithZeroForEqualPicturesAndALimitOfZero) {
  const TemporaryFolder folder;
  write_image(folder / "a.exr", filled(4, 4, 0.5F));
  const ProgramResult result = splotchcl_in(folder, "compare a.exr a.exr --limit 0");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, HasSubstr("equal"));
}

TEST(Compare, HasANoteWhereOneFileHoldsLightAndTheOtherDisplayValues) {
  const TemporaryFolder folder;
  for (const char* const name : {"a.exr", "a.tif", "a.png", "b.png"})
    write_image(folder / name, filled(4, 4, 0.5F), {2.2});
  for (const char* const files : {"a.exr a.png", "a.png a.exr", "a.tif a.png"})
    EXPECT_THAT(splotchcl_in(folder, std::string("compare ") + files).err,
                HasSubstr("a.png display values"));
  for (const char* const files : {"a.exr a.tif", "a.png b.png"})
    EXPECT_THAT(splotchcl_in(folder, std::string("compare ") + files).err,
                Not(HasSubstr("display values")));
}

TEST(Compare, EndsWithOneBeyondTheLimitOnly) {
  const TemporaryFolder folder;
  write_image(folder / "a.exr", filled(4, 4, 0.5F));
  write_image(folder / "b.exr", filled(4, 4, 0.75F));
  EXPECT_EQ(splotchcl_in(folder, "compare a.exr b.exr --limit 0.2").exit_code, 1);
  EXPECT_EQ(splotchcl_in(folder, "compare a.exr b.exr --limit 0.25").exit_code, 0);
  EXPECT_EQ(splotchcl_in(folder, "compare a.exr b.exr").exit_code, 0);
}

TEST(Compare, NamesTheWorstPixelAndHowManyAreBeyond) {
  const TemporaryFolder folder;
  Image image = filled(4, 3, 0.5F);
  write_image(folder / "b.exr", image);
  image.at(3, 1)[2] = 1;
  write_image(folder / "a.exr", image);
  const ProgramResult result = splotchcl_in(folder, "compare a.exr b.exr --limit 0.01");
  EXPECT_THAT(result.out, AllOf(HasSubstr("blue of pixel 3,1"), HasSubstr("1 of 12 pixels")));
}

TEST(Compare, CountsNotANumberAsBeyondEveryLimit) {
  const TemporaryFolder folder;
  Image image = filled(2, 2, 0.5F);
  write_image(folder / "b.exr", image);
  image.at(0, 1)[0] = std::numeric_limits<float>::quiet_NaN();
  write_image(folder / "a.exr", image);
  EXPECT_EQ(splotchcl_in(folder, "compare a.exr b.exr --limit 1e30").exit_code, 1);
  EXPECT_EQ(splotchcl_in(folder, "compare a.exr a.exr --limit 1e30").exit_code, 1);
}

TEST(Compare, RefusesDifferentSizesAndSaysBoth) {
  const TemporaryFolder folder;
  write_image(folder / "a.png", Image(3, 2));
  write_image(folder / "b.png", Image(2, 3));
  const ProgramResult result = splotchcl_in(folder, "compare a.png b.png");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("a.png"), HasSubstr("b.png"), HasSubstr("3x2"), HasSubstr("2x3")));
}

TEST(Compare, LeavesAlphaOutWhereAPictureHasNone) {
  const TemporaryFolder folder;
  Image image = filled(2, 2, 1);
  write_image(folder / "a.png", image);
  image.at(0, 0)[3] = 0;
  write_image(folder / "b.exr", image);
  const ProgramResult result = splotchcl_in(folder, "compare a.png b.exr --limit 0");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, AllOf(HasSubstr("a.png"), HasSubstr("alpha")));
}

TEST(Compare, GivesItsFiguresAsJson) {
  const TemporaryFolder folder;
  write_image(folder / "a.exr", filled(2, 2, 0.5F));
  write_image(folder / "b.exr", filled(2, 2, 0.75F));
  const ProgramResult result = splotchcl_in(folder, "compare a.exr b.exr --json --limit 0.1");
  EXPECT_EQ(result.exit_code, 1);
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_DOUBLE_EQ(json["overall"]["maximum"], 0.25);
  EXPECT_DOUBLE_EQ(json["red"]["rms"], 0.25);
  EXPECT_EQ(json["pixels_beyond"], 4);
}

TEST(Compare, WritesAPictureOfTheDifference) {
  const TemporaryFolder folder;
  Image image = filled(2, 2, 0.5F);
  write_image(folder / "b.exr", image);
  image.at(1, 0)[0] = 0.75F;
  write_image(folder / "a.exr", image);
  EXPECT_EQ(splotchcl_in(folder, "compare a.exr b.exr --diff d.png").exit_code, 0);
  const Image difference = read_image(folder / "d.png");
  EXPECT_EQ(difference.at(1, 0)[0], 1);
  EXPECT_NEAR(difference.at(0, 0)[0], 0.5, 1.0 / 255);
}

TEST(Compare, NamesAPictureThatCannotBeRead) {
  const TemporaryFolder folder;
  write_image(folder / "a.png", Image(2, 2));
  const ProgramResult result = splotchcl_in(folder, "compare a.png missing.png");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
  EXPECT_THAT(result.err, HasSubstr("missing.png"));
}

}  // namespace
}  // namespace splotchcl::test
