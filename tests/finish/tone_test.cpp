// The curves that bring light within what a display can show.
#include "finish/tone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "finish/finish_pictures.h"

namespace splotchcl::test {
namespace {

constexpr ToneCurve every_curve[] = {ToneCurve::linear, ToneCurve::asinh, ToneCurve::filmic};
constexpr ToneCurve bent_curves[] = {ToneCurve::asinh, ToneCurve::filmic};

std::array<float, 3> toned(const std::array<float, 3>& light, ToneCurve curve, double white) {
  Image image = plain_image(1, 1, light);
  apply_tone(image, curve, white);
  return {image.pixels[0], image.pixels[1], image.pixels[2]};
}

TEST(Tone, KeepsDarkness) {
  for (const ToneCurve curve : every_curve)
    EXPECT_EQ(tone(curve, 0, 7), 0);
}

TEST(Tone, MakesWhiteOfTheWhitePoint) {
  for (const ToneCurve curve : every_curve) {
    for (const double white : {1e-3, 1.0, 250.0})
      EXPECT_DOUBLE_EQ(tone(curve, white, white), 1);
  }
}

TEST(Tone, RisesUpToTheWhitePoint) {
  for (const ToneCurve curve : every_curve) {
    for (const double white : {0.1, 1.0, 300.0}) {
      double before = 0;
      for (double light = 1e-9 * white; light <= white; light *= 1.01) {
        EXPECT_GT(tone(curve, light, white), before);
        before = tone(curve, light, white);
      }
    }
  }
}

TEST(Tone, ShowsWhatIsBrighterThanWhiteAsWhite) {
  for (const ToneCurve curve : bent_curves)
    EXPECT_EQ(tone(curve, 5, 2), 1);
}

TEST(Tone, KeepsLightThatIsBrighterThanWhiteOnALine) {
  EXPECT_EQ(tone(ToneCurve::linear, 5, 2), 2.5);
}

// asinh(30) / asinh(100), by hand from log(x + sqrt(x^2 + 1)).
TEST(Tone, IsAnAreaSine) {
  EXPECT_NEAR(tone(ToneCurve::asinh, 3, 10), 4.0946222 / 5.2983424, 1e-7);
}

// Hable's own formula, whose value at 0 is taken off; it loses digits there.
TEST(Tone, IsAFilmsCurve) {
  const auto hable = [](double x) {
    return (x * (0.22 * x + 0.03) + 0.002) / (x * (0.22 * x + 0.3) + 0.06) - 0.01 / 0.3;
  };
  for (const double light : {0.01, 0.18, 1.0, 6.0, 11.2})
    EXPECT_NEAR(tone(ToneCurve::filmic, light, 11.2), hable(light) / hable(11.2), 1e-14);
}

TEST(Tone, KeepsHues) {
  const std::array<float, 3> light = {0.02F, 3.5F, 0.7F};
  for (const ToneCurve curve : every_curve) {
    const std::array<float, 3> shown = toned(light, curve, 9);
    EXPECT_NEAR(shown[0] / shown[1], light[0] / light[1], 1e-7);
    EXPECT_NEAR(shown[2] / shown[1], light[2] / light[1], 1e-7);
  }
}

TEST(Tone, KeepsHuesBeyondWhite) {
  for (const ToneCurve curve : bent_curves) {
    const std::array<float, 3> shown = toned({40, 20, 10}, curve, 9);
    EXPECT_FLOAT_EQ(shown[0], 1);
    EXPECT_FLOAT_EQ(shown[1], 0.5F);
    EXPECT_FLOAT_EQ(shown[2], 0.25F);
  }
}

TEST(Tone, ShowsPureColorsAsBrightAsGray) {
  for (const ToneCurve curve : bent_curves)
    EXPECT_FLOAT_EQ(toned({0, 0, 2}, curve, 9)[2], toned({2, 2, 2}, curve, 9)[2]);
}

TEST(Tone, LeavesEveryBitOfALineUpToWhite) {
  const std::array<float, 3> light = {0.123F, 17.3F, 0.7F};
  EXPECT_EQ(toned(light, ToneCurve::linear, 1), light);
}

TEST(Tone, LeavesAlpha) {
  Image image = plain_image(1, 1, {0.5F, 0.5F, 0.5F});
  image.pixels[3] = 0.375F;
  apply_tone(image, ToneCurve::filmic, 4);
  EXPECT_EQ(image.pixels[3], 0.375F);
}

TEST(Tone, LeavesWhatIsNotFiniteForTheFileToTell) {
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(toned({1, infinity, 2}, ToneCurve::asinh, 4)[1], infinity);
  EXPECT_TRUE(std::isnan(toned({1, std::nanf(""), 2}, ToneCurve::asinh, 4)[1]));
}

}  // namespace
}  // namespace splotchcl::test
