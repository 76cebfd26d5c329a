// Both eyes' pictures in one, for glasses of red and cyan.
#include "finish/finish_pictures.h"
#include "finish/joined_pictures.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

constexpr StereoLayout every_layout[] = {StereoLayout::anaglyph, StereoLayout::anaglyph_half_color,
                                         StereoLayout::anaglyph_gray};
using Light = std::array<float, 3>;

Light combined(const Light& left, const Light& right, StereoLayout layout, double gamma = 2.2) {
  const Image both = anaglyph(plain_image(1, 1, left), plain_image(1, 1, right), layout, gamma);
  return {both.pixels[0], both.pixels[1], both.pixels[2]};
}

// The matrices of Dubois add up to white within a per cent.
TEST(Anaglyph, KeepsWhiteAndBlack) {
  for (const StereoLayout layout : every_layout) {
    for (const float channel : combined({1, 1, 1}, {1, 1, 1}, layout))
      EXPECT_NEAR(channel, 1, 0.01);
    EXPECT_EQ(combined({0, 0, 0}, {0, 0, 0}, layout), (Light{0, 0, 0}));
  }
}

TEST(Anaglyph, ShowsTheLeftEyeInRed) {
  for (const StereoLayout layout : every_layout) {
    const Light shown = combined({0.8F, 0.8F, 0.8F}, {0, 0, 0}, layout);
    EXPECT_GT(shown[0], 0.7F);
    EXPECT_LT(shown[1], 0.01F);
    EXPECT_LT(shown[2], 0.01F);
  }
}

TEST(Anaglyph, ShowsTheRightEyeInGreenAndBlue) {
  for (const StereoLayout layout : every_layout) {
    const Light shown = combined({0, 0, 0}, {0.8F, 0.8F, 0.8F}, layout);
    EXPECT_LT(shown[0], 0.01F);
    EXPECT_GT(shown[1], 0.7F);
    EXPECT_GT(shown[2], 0.7F);
  }
}

TEST(Anaglyph, HasTheNumbersOfDubois) {
  const Light shown = combined({0, 0.5F, 0}, {0.25F, 0, 0.5F}, StereoLayout::anaglyph);
  EXPECT_NEAR(shown[0], 0.500484 * 0.5 - 0.0434706 * 0.25 - 0.00155529 * 0.5, 1e-6);
  EXPECT_NEAR(shown[1], -0.0378246 * 0.5 + 0.378476 * 0.25 - 0.0184503 * 0.5, 1e-6);
  EXPECT_NEAR(shown[2], -0.0205971 * 0.5 - 0.0721527 * 0.25 + 1.2264 * 0.5, 1e-6);
}

TEST(Anaglyph, KeepsTheRightEyesColorsByHalf) {
  const Light shown =
      combined({0.5F, 0.5F, 0.5F}, {0.9F, 0.3F, 0.1F}, StereoLayout::anaglyph_half_color);
  EXPECT_FLOAT_EQ(shown[0], 0.5F);
  EXPECT_FLOAT_EQ(shown[1], 0.3F);
  EXPECT_FLOAT_EQ(shown[2], 0.1F);
}

TEST(Anaglyph, HasNoColorsInGray) {
  const Light shown = combined({0.9F, 0.3F, 0.1F}, {0.9F, 0.3F, 0.1F}, StereoLayout::anaglyph_gray);
  const double luminance = 0.2126 * 0.9 + 0.7152 * 0.3 + 0.0722 * 0.1;
  for (const float channel : shown)
    EXPECT_NEAR(channel, luminance, 1e-6);
}

// With a gamma of 1 the file holds light as it is, which the display shows to the power 2.2.
TEST(Anaglyph, AddsWhatTheDisplayEmits) {
  const Light shown =
      combined({0.5F, 0.2F, 0.7F}, {0.5F, 0.2F, 0.7F}, StereoLayout::anaglyph_gray, 1);
  const double emitted =
      0.2126 * std::pow(0.5, 2.2) + 0.7152 * std::pow(0.2, 2.2) + 0.0722 * std::pow(0.7, 2.2);
  EXPECT_NEAR(shown[0], std::pow(emitted, 1 / 2.2), 1e-6);
}

TEST(Anaglyph, TakesLightBeyondWhiteForWhite) {
  for (const StereoLayout layout : every_layout)
    EXPECT_EQ(combined({40, 2, 1}, {3, 90, 1}, layout), combined({1, 1, 1}, {1, 1, 1}, layout));
}

TEST(Anaglyph, HasTheMeanOfBothOpacities) {
  Image left(1, 1), right(1, 1);
  left.pixels[3] = 0.5F;
  right.pixels[3] = 1;
  EXPECT_EQ(anaglyph(left, right, StereoLayout::anaglyph, 1).pixels[3], 0.75F);
}

}  // namespace
}  // namespace splotchcl::test
