// Anaglyphs, bloom, and a camera's light.
#include "finish/effects.h"

#include "finish/finish_pictures.h"
#include "finish/tone.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Both eyes' pictures in one, for glasses of red and cyan.

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

constexpr int width = 120, height = 90;

Image bloomed(Image image, double part) {
  add_bloom(image, part);
  return image;
}

Image point(int x, int y) {
  Image image(width, height);
  std::fill_n(image.at(x, y), 3, 1000.0F);
  return image;
}

Image random_light() {
  std::mt19937 random(3);
  std::exponential_distribution<float> light(0.2F);
  Image image(width, height);
  for (float& value : image.pixels)
    value = light(random);
  return image;
}

double sum_of(const Image& image, std::size_t channel) {
  double sum = 0;
  for (std::size_t i = channel; i < image.pixels.size(); i += 4)
    sum += static_cast<double>(image.pixels[i]);
  return sum;
}

TEST(Bloom, KeepsAllLight) {
  const Image image = random_light();
  for (const double part : {0.14, 1.0}) {
    for (const std::size_t channel : {0, 1, 2}) {
      const double before = sum_of(image, channel);
      EXPECT_NEAR(sum_of(bloomed(image, part), channel), before, 1e-4 * before);
    }
  }
}

TEST(Bloom, KeepsTheLightOfAPointInACorner) {
  EXPECT_NEAR(sum_of(bloomed(point(0, 0), 1), 0), 1000, 0.1);
}

TEST(Bloom, IsTheSameAroundEveryPoint) {
  const Image one = bloomed(point(50, 40), 0.5), other = bloomed(point(57, 45), 0.5);
  for (int y = -25; y <= 25; ++y) {
    for (int x = -25; x <= 25; ++x)
      EXPECT_NEAR(one.at(50 + x, 40 + y)[0], other.at(57 + x, 45 + y)[0], 1e-4);
  }
}

TEST(Bloom, AddsUpAsLightDoes) {
  Image both = random_light();
  const Image one = bloomed(both, 0.3), other = bloomed(point(30, 60), 0.3);
  for (std::size_t c = 0; c < 3; ++c)
    both.at(30, 60)[c] += 1000;
  const Image together = bloomed(both, 0.3);
  for (std::size_t i = 0; i < together.pixels.size(); ++i) {
    if (i % 4 == 3) continue;
    EXPECT_NEAR(together.pixels[i], one.pixels[i] + other.pixels[i], 1e-3);
  }
}

TEST(Bloom, MakesBellsOfThePointsThatItBlurs) {
  constexpr double two_pi = 6.283185307179586;
  for (const double deviation : {2.0, 5.5}) {
    const Image bell = blurred(point(60, 45), deviation);
    const double peak = 1000 / (two_pi * deviation * deviation);
    for (int x = 0; x < 20; ++x) {
      const double expected = peak * std::exp(-0.5 * x * x / (deviation * deviation));
      EXPECT_NEAR(bell.at(60 + x, 45)[0], expected, 0.08 * peak) << deviation << " at " << x;
      EXPECT_NEAR(bell.at(60 + x, 45)[0], bell.at(60 - x, 45)[0], 1e-9);
    }
  }
}

TEST(Bloom, HasTheWidthThatIsAskedFor) {
  for (const double deviation : {0.3, 1.0, 3.7}) {
    const Image bell = blurred(point(60, 45), deviation);
    double squares = 0;
    for (int x = -40; x <= 40; ++x) {
      for (int y = -40; y <= 40; ++y)
        squares += x * x * static_cast<double>(bell.at(60 + x, 45 + y)[0]) / 1000;
    }
    EXPECT_NEAR(squares, deviation * deviation, 1e-3);
  }
}

TEST(Bloom, OfNoPartChangesNothing) {
  const Image image = random_light();
  EXPECT_EQ(bloomed(image, 0).pixels, image.pixels);
}

TEST(Bloom, LeavesOpacityAlone) {
  const Image image = random_light(), changed = bloomed(image, 0.7);
  for (std::size_t i = 3; i < image.pixels.size(); i += 4)
    EXPECT_EQ(changed.pixels[i], image.pixels[i]);
}

TEST(Bloom, FitsIntoThePictureOfOnePixel) {
  EXPECT_EQ(bloomed(plain_image(1, 1, {2, 3, 4}), 0.5).at(0, 0)[1], 3);
}

// Highlights that end in white, and the balance of white.

using Rgb = std::array<float, 3>;

constexpr ToneCurve curves[] = {ToneCurve::linear, ToneCurve::asinh, ToneCurve::filmic};

Rgb first_pixel(const Image& image) {
  return {image.pixels[0], image.pixels[1], image.pixels[2]};
}

Rgb with_highlights(const Rgb& light, ToneCurve curve, double highlights) {
  Image image = plain_image(1, 1, light);
  apply_tone(image, curve, 1, highlights);
  return first_pixel(image);
}

TEST(Highlights, EndInWhite) {
  for (const ToneCurve curve : {ToneCurve::asinh, ToneCurve::filmic})
    EXPECT_EQ(with_highlights({5, 0.1F, 0}, curve, 1), (Rgb{1, 1, 1}));
}

TEST(Highlights, NeverFallAsLightRises) {
  for (const ToneCurve curve : curves) {
    Rgb before = {0, 0, 0};
    for (float light = 1e-4F; light < 3; light *= 1.02F) {
      const Rgb shown = with_highlights({light, 0.3F * light, 0.01F * light}, curve, 0.8);
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_GE(shown[c], before[c]);
      before = shown;
    }
  }
}

TEST(Highlights, KeepGrayAndBlack) {
  for (const ToneCurve curve : curves) {
    for (const float light : {0.0F, 0.2F, 0.9F}) {
      const Rgb shown = with_highlights({light, light, light}, curve, 1);
      EXPECT_FLOAT_EQ(shown[0], static_cast<float>(tone(curve, static_cast<double>(light), 1)));
      EXPECT_FLOAT_EQ(shown[1], shown[0]);
      EXPECT_FLOAT_EQ(shown[2], shown[0]);
    }
  }
}

TEST(Highlights, LeaveDarkHuesAlone) {
  const Rgb shown = with_highlights({0.05F, 0.02F, 0.01F}, ToneCurve::linear, 1);
  EXPECT_NEAR(shown[1] / shown[0], 0.4F, 1e-4F);
}

Rgb balanced(const Rgb& light, double kelvin) {
  Image image = plain_image(1, 1, light);
  balance_white(image, kelvin);
  return first_pixel(image);
}

// Black bodies as linear Rec. 709, from the CIE 1931 chromaticities (0.4369, 0.4041) of 3000 K and
// (0.2807, 0.2884) of 10000 K.
TEST(WhiteBalance, MakesWhiteOfABlackBody) {
  const Rgb warm = {1.7705F, 0.8444F, 0.2721F}, cold = {0.8721F, 0.9947F, 1.4294F};
  for (const auto& [light, kelvin] : {std::pair(warm, 3000.0), std::pair(cold, 10000.0)}) {
    const Rgb white = balanced(light, kelvin);
    EXPECT_NEAR(white[0], white[1], 0.02) << kelvin;
    EXPECT_NEAR(white[2], white[1], 0.02) << kelvin;
  }
}

TEST(WhiteBalance, MakesAPictureBluerThatWasTakenInWarmLight) {
  const Rgb shown = balanced({1, 1, 1}, 4000);
  EXPECT_GT(shown[2], shown[0]);
}

TEST(WhiteBalance, ShowsNoLightBelowZero) {
  for (const float value : balanced({0, 0, 1}, 1700))
    EXPECT_GE(value, 0);
}

}  // namespace
}  // namespace splotchcl::test
