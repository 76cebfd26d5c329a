// Highlights that end in white, and the balance of white.
#include "finish/finish_pictures.h"
#include "finish/tone.h"
#include "finish/white_balance.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

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
