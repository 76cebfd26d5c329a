#include "splotchcl/compare.h"

#include "testing.h"

namespace splotchcl {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

Image filled(int width, int height, float value) {
  Image image(width, height);
  for (float& v : image.pixels)
    v = value;
  return image;
}

TEST(CompareImages, FindsNothingBetweenEqualPictures) {
  const Image image = filled(3, 2, 0.25F);
  const ImageDifference difference = compare_images(image, image);
  EXPECT_EQ(difference.pixels, 6U);
  EXPECT_EQ(difference.pixels_beyond, 0U);
  EXPECT_EQ(difference.worst, 0);
  EXPECT_EQ(difference.overall.maximum, 0);
  EXPECT_EQ(difference.overall.rms, 0);
  EXPECT_EQ(difference.overall.relative_l2, 0);
  EXPECT_EQ(difference.overall.psnr, std::numeric_limits<double>::infinity());
}

TEST(CompareImages, GivesTheFiguresOfEachChannelAndOfAll) {
  const Image reference = filled(2, 2, 0.5F);
  Image image = reference;
  image.at(1, 0)[1] = 0.75F;
  const ImageDifference difference = compare_images(image, reference);
  // Green: one of four values is off by 1/4, the reference's values are 1/2.
  EXPECT_DOUBLE_EQ(difference.channels[1].maximum, 0.25);
  EXPECT_DOUBLE_EQ(difference.channels[1].rms, 0.125);
  EXPECT_DOUBLE_EQ(difference.channels[1].psnr, -20 * std::log10(0.125));
  EXPECT_DOUBLE_EQ(difference.channels[1].relative_l2, 0.25);
  EXPECT_EQ(difference.channels[0].rms, 0);
  // Over all: one of sixteen.
  EXPECT_DOUBLE_EQ(difference.overall.rms, 0.0625);
  EXPECT_DOUBLE_EQ(difference.overall.relative_l2, 0.125);
}

TEST(CompareImages, NamesTheWorstPixelAndChannel) {
  const Image reference = filled(4, 3, 0);
  Image image = reference;
  image.at(0, 0)[0] = 0.1F;
  image.at(2, 1)[2] = -0.2F;
  const ImageDifference difference = compare_images(image, reference);
  EXPECT_FLOAT_EQ(static_cast<float>(difference.worst), 0.2F);
  EXPECT_EQ(difference.worst_x, 2);
  EXPECT_EQ(difference.worst_y, 1);
  EXPECT_EQ(difference.worst_channel, 2);
}

TEST(CompareImages, MeasuresAgainstTheReferenceWhereItIsBrighterThanWhite) {
  const Image reference = filled(1, 1, 8);
  const Image image = filled(1, 1, 8.5F);
  EXPECT_DOUBLE_EQ(compare_images(image, reference).worst, 0.0625);
  EXPECT_EQ(compare_images(image, reference, 0.0625).pixels_beyond, 0U);
  EXPECT_EQ(compare_images(image, reference, 0.0624).pixels_beyond, 1U);
}

TEST(CompareImages, CountsAPixelOnceHoweverManyChannelsAreBeyondTheLimit) {
  const ImageDifference difference = compare_images(filled(2, 1, 1), filled(2, 1, 0), 0.5);
  EXPECT_EQ(difference.pixels_beyond, 2U);
}

TEST(CompareImages, CountsEveryValueThatIsNotFiniteAsBeyondAnyLimit) {
  for (const float bad : {nan, infinity, -infinity}) {
    const Image good = filled(2, 1, 1);
    Image broken = good;
    broken.at(1, 0)[3] = bad;
    for (const auto& [a, b] : {std::pair{broken, good}, {good, broken}, {broken, broken}}) {
      const ImageDifference difference =
          compare_images(a, b, std::numeric_limits<double>::infinity());
      EXPECT_EQ(difference.pixels_beyond, 1U);
      EXPECT_EQ(difference.pixels_not_finite, 1U);
      EXPECT_EQ(difference.worst_x, 1);
      EXPECT_EQ(difference.worst_channel, 3);
    }
  }
}

TEST(CompareImages, LeavesAlphaOutWhenAsked) {
  Image image = filled(1, 1, 0);
  image.at(0, 0)[3] = 1;
  const ImageDifference difference =
      compare_images(image, filled(1, 1, 0), 0, ComparedChannels::rgb);
  EXPECT_EQ(difference.pixels_beyond, 0U);
  EXPECT_EQ(difference.overall.maximum, 0);
}

TEST(CompareImages, RefusesDifferentSizesAndNamesBoth) {
  EXPECT_THAT([&] { (void)compare_images(Image(3, 2), Image(2, 3)); },
              ThrowsMessage<UsageError>(AllOf(HasSubstr("3x2"), HasSubstr("2x3"))));
}

TEST(DifferenceImage, ShowsWhereAndHowFarThePicturesDiffer) {
  const Image reference = filled(2, 1, 0.5F);
  Image image = reference;
  image.at(1, 0)[0] = 0.25F;
  const Image difference = difference_image(image, reference, 0.5);
  EXPECT_EQ(difference.at(0, 0)[0], 0.5F);
  EXPECT_EQ(difference.at(1, 0)[0], 0.25F) << "darker by half of white";
  EXPECT_EQ(difference_image(reference, image, 0.5).at(1, 0)[0], 0.75F) << "and brighter";
  EXPECT_EQ(difference.at(1, 0)[1], 0.5F);
  EXPECT_EQ(difference.at(1, 0)[3], 1);
}

TEST(DifferenceImage, PaintsWhatIsNotFiniteMagenta) {
  Image image = filled(1, 1, 0);
  image.at(0, 0)[1] = nan;
  const Image difference = difference_image(image, filled(1, 1, 0), 1);
  EXPECT_EQ(difference.at(0, 0)[0], 1);
  EXPECT_EQ(difference.at(0, 0)[1], 0);
  EXPECT_EQ(difference.at(0, 0)[2], 1);
}

}  // namespace
}  // namespace splotchcl
