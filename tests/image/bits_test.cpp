#include "image/blue_noise.h"
#include "image/void_and_cluster.h"
#include "splotchcl/image_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// PNG and TIFF files of 16 bits, and what files say of their colors.

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

// How 8 bits are rounded so that faint light has no steps.

constexpr int side = 64;  // of the tile

ImageFileOptions dithered() {
  ImageFileOptions options;
  options.dithers = true;
  return options;
}

Image even(int width, int height, float light) {
  Image image(width, height);
  std::fill(image.pixels.begin(), image.pixels.end(), light);
  return image;
}

double mean(const std::vector<std::uint8_t>& bytes) {
  double sum = 0;
  for (const std::uint8_t byte : bytes)
    sum += byte;
  return sum / static_cast<double>(bytes.size());
}

TEST(BlueNoise, IsThatOfVoidsAndClusters) {
  const std::vector<std::uint16_t> found = test::VoidAndCluster(side).ranks();
  EXPECT_TRUE(std::equal(found.begin(), found.end(), blue_noise_ranks.begin()));
}

TEST(BlueNoise, HasEachRankOnce) {
  auto ranks = blue_noise_ranks;
  std::sort(ranks.begin(), ranks.end());
  for (std::size_t i = 0; i < ranks.size(); ++i)
    EXPECT_EQ(ranks[i], i);
}

// White noise would have neighbours as like as any two places: sqrt(1/6) = 0.41 of all ranks.
TEST(BlueNoise, HasNeighboursThatDiffer) {
  double squares = 0;
  for (std::size_t y = 0; y < side; ++y) {
    for (std::size_t x = 0; x < side; ++x) {
      const double here = blue_noise_ranks[side * y + x];
      const double right = blue_noise_ranks[side * y + (x + 1) % side];
      squares += (here - right) * (here - right);
    }
  }
  EXPECT_GT(std::sqrt(squares / (side * side)) / (side * side), 0.45);
}

// Ranks are 4096 steps: a mean is at most half of one off, and floats add a little.
TEST(Dither, HasMeanZeroOverATile) {
  for (const double value : {0.1, 7.3, 100.01, 128.5, 254.9}) {
    const Image image = even(side, side, static_cast<float>(value / 255));
    EXPECT_NEAR(mean(display_bytes("a", image, dithered())), value, 0.5 / 4096 + 3e-5) << value;
  }
}

TEST(Dither, IsOffByLessThanOneStep) {
  Image image(256, 16);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<float>(i) / static_cast<float>(image.pixels.size());
  const std::vector<std::uint8_t> bytes = display_bytes("a", image, dithered());
  for (std::size_t i = 0; i < bytes.size(); ++i)
    EXPECT_LT(std::abs(bytes[i] - 255 * image.pixels[i / 3 * 4 + i % 3]), 1) << i;
}

TEST(Dither, KeepsWhatEightBitsHold) {
  for (int byte = 0; byte < 256; ++byte) {
    const Image image = even(side, side, static_cast<float>(byte) / 255);
    const std::vector<std::uint8_t> bytes = display_bytes("a", image, dithered());
    EXPECT_EQ(*std::min_element(bytes.begin(), bytes.end()), byte);
    EXPECT_EQ(*std::max_element(bytes.begin(), bytes.end()), byte);
  }
}

TEST(Dither, KeepsGrayGray) {
  const std::vector<std::uint8_t> bytes = display_bytes("a", even(9, 9, 0.2F), dithered());
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    EXPECT_EQ(bytes[i], bytes[i + 1]);
    EXPECT_EQ(bytes[i], bytes[i + 2]);
  }
}

TEST(Dither, HasTheSameBitsEachTime) {
  const Image image = even(70, 130, 0.123F);
  EXPECT_EQ(display_bytes("a", image, dithered()), display_bytes("b", image, dithered()));
}

TEST(Dither, HasTheWholePicturesBitsInACrop) {
  const std::vector<std::uint8_t> whole = display_bytes("a", even(100, 90, 0.123F), dithered());
  ImageFileOptions options = dithered();
  options.places = {31, 77, 20, 13};
  const std::vector<std::uint8_t> part = display_bytes("a", even(20, 13, 0.123F), options);
  for (std::size_t y = 0; y < 13; ++y) {
    for (std::size_t x = 0; x < 60; ++x)
      EXPECT_EQ(part[60 * y + x], whole[300 * (y + 77) + 3 * 31 + x]);
  }
}

TEST(Dither, IsTheSameInViewsBesideEachOther) {
  ImageFileOptions options = dithered();
  options.places = {0, 0, 30, 20};
  const std::vector<std::uint8_t> pair = display_bytes("a", even(60, 20, 0.123F), options);
  for (std::size_t y = 0; y < 20; ++y) {
    for (std::size_t x = 0; x < 90; ++x)
      EXPECT_EQ(pair[180 * y + x], pair[180 * y + 90 + x]);
  }
}

TEST(Dither, LeavesTruncatedBitsAlone) {
  ImageFileOptions options;
  options.truncates = true;
  const std::vector<std::uint8_t> plain = display_bytes("a", even(9, 9, 0.123F), options);
  options.dithers = true;
  EXPECT_EQ(display_bytes("a", even(9, 9, 0.123F), options), plain);
}

// The 8 bits of a picture are those that its file would have.

Image pixels(const std::vector<float>& values) {
  Image image(static_cast<int>(values.size() / 4), 1);
  image.pixels = values;
  return image;
}

TEST(DisplayBytes, LeaveOutAlphaAndClamp) {
  const Image image = pixels({0, 1, 2, 0.5f, -1, 1, 0, 1});
  EXPECT_THAT(display_bytes("picture", image), ElementsAre(0, 255, 255, 0, 255, 0));
}

TEST(DisplayBytes, AreThoseOfTheFile) {
  const TemporaryFolder folder;
  std::vector<float> values;
  for (int i = 0; i < 4 * 64; ++i)
    values.push_back(static_cast<float>(i) / 255);
  ImageFileOptions options;
  options.gamma = 2.2;
  write_image(folder / "a.png", pixels(values), options);
  const Image read = read_image(folder / "a.png");
  const std::vector<std::uint8_t> bytes = display_bytes("picture", pixels(values), options);
  ASSERT_EQ(bytes.size(), 3U * 64);
  for (std::size_t i = 0; i < bytes.size(); ++i)
    EXPECT_EQ(bytes[i], std::lround(255 * read.pixels[i / 3 * 4 + i % 3])) << i;
}

TEST(DisplayBytes, RefuseWhatIsNotANumber) {
  const Image image = pixels({0, std::numeric_limits<float>::quiet_NaN(), 0, 1});
  EXPECT_THAT([&] { display_bytes("the picture", image); },
              ThrowsMessage<DataError>(HasSubstr("the picture")));
}

}  // namespace
}  // namespace splotchcl::test
