// PNG and TIFF files of 16 bits, and what files say of their colors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "splotchcl/error.h"
#include "splotchcl/image_file.h"
#include "temporary_folder.h"

namespace splotchcl {
namespace {

using splotchcl::test::read_text;
using splotchcl::test::TemporaryFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

ImageFileOptions bits(int count, double gamma = 1) {
  ImageFileOptions options;
  options.bits = count;
  options.gamma = gamma;
  return options;
}

Image sixteen_bit_ramp(int width, int height, float brightest) {
  Image image(width, height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] =
        brightest * static_cast<float>(i) / static_cast<float>(image.pixels.size() - 1);
  }
  return image;
}

class SixteenBits : public ::testing::TestWithParam<const char*> {
 protected:
  TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / (std::string("picture.") + GetParam());
};
INSTANTIATE_TEST_SUITE_P(ImageFile, SixteenBits, ::testing::Values("png", "tif", "tiff"));

// The reader gives floats, which add their own 6e-8.
TEST_P(SixteenBits, RoundByHalfAStepAtMost) {
  const Image image = sixteen_bit_ramp(61, 47, 1);
  write_image(path_, image, bits(16));
  const Image read = read_image(path_);
  ASSERT_EQ(read.pixels.size(), image.pixels.size());
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (i % 4 == 3) continue;
    EXPECT_NEAR(read.pixels[i], image.pixels[i], 1.0 / 131070 + 6e-8);
  }
  EXPECT_FALSE(read_image_info(path_).is_float);
  EXPECT_FALSE(read_image_info(path_).has_alpha);
}

TEST_P(SixteenBits, HoldDisplayValues) {
  Image image(1, 1);
  image.pixels = {0.25F, 4, -1, 1};
  write_image(path_, image, bits(16, 2));
  const Image read = read_image(path_);
  EXPECT_NEAR(read.pixels[0], 0.5, 1.0 / 131070 + 6e-8);
  EXPECT_EQ(read.pixels[1], 1);
  EXPECT_EQ(read.pixels[2], 0);
}

TEST_P(SixteenBits, MayBeEight) {
  const Image image = sixteen_bit_ramp(9, 6, 1);
  write_image(path_, image, bits(8));
  const Image read = read_image(path_);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (i % 4 == 3) continue;
    EXPECT_FLOAT_EQ(read.pixels[i],
                    static_cast<float>(std::lround(255 * image.pixels[i])) / 255.0F);
  }
}

TEST_P(SixteenBits, AreTheSameBytesEachTime) {
  write_image(path_, sixteen_bit_ramp(61, 47, 1), bits(16));
  const std::string first = read_text(path_);
  write_image(path_, sixteen_bit_ramp(61, 47, 1), bits(16));
  EXPECT_EQ(read_text(path_), first);
}

TEST_P(SixteenBits, RefuseWhatIsNotANumber) {
  Image image(2, 2);
  image.at(1, 1)[2] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT([&] { write_image(path_, image, bits(16)); },
              ThrowsMessage<DataError>(AllOf(HasSubstr("pixel 1,1"), HasSubstr("16 bits"))));
}

TEST(ImageBits, OfFormatsThatHoldEightAreRefused) {
  const TemporaryFolder folder;
  for (const char* name : {"a.jpg", "a.webp", "a.bmp", "a.tga"}) {
    EXPECT_THAT([&] { write_image(folder / name, Image(2, 2), bits(16)); },
                ThrowsMessage<UsageError>(AllOf(HasSubstr("image.bits"), HasSubstr(".png"))));
  }
  EXPECT_EQ(folder.count_files(), 0U);
}

TEST(ImageBits, LeaveFormatsOfFloatsAsTheyAre) {
  const TemporaryFolder folder;
  const Image image = sixteen_bit_ramp(5, 4, 20);
  write_image(folder / "a.exr", image, bits(16));
  EXPECT_EQ(read_image(folder / "a.exr").pixels, image.pixels);
}

TEST(ColorSpaces, OfPngFilesAreSaidToBeSrgb) {
  const TemporaryFolder folder;
  for (const int count : {8, 16}) {
    write_image(folder / "a.png", Image(2, 2), bits(count));
    EXPECT_THAT(read_text(folder / "a.png"), HasSubstr("sRGB"));
  }
}

// Names in profiles have two bytes a letter.
TEST(ColorSpaces, OfTiffFilesAreThatOfTheirValues) {
  const TemporaryFolder folder;
  const std::string srgb("\0s\0R\0G\0B", 8), linear("\0l\0i\0n\0e\0a\0r", 12);
  write_image(folder / "a.tif", Image(2, 2), bits(16));
  EXPECT_THAT(read_text(folder / "a.tif"), AllOf(HasSubstr(srgb), Not(HasSubstr(linear))));
  write_image(folder / "a.tif", Image(2, 2));
  EXPECT_THAT(read_text(folder / "a.tif"), AllOf(HasSubstr(linear), Not(HasSubstr(srgb))));
}

TEST(ColorSpaces, OfExrFilesHaveTheirPrimaries) {
  const TemporaryFolder folder;
  write_image(folder / "a.exr", Image(2, 2));
  EXPECT_THAT(read_text(folder / "a.exr"), HasSubstr("chromaticities"));
}

}  // namespace
}  // namespace splotchcl
