#include "finish/tone.h"

#include "finish/finish_pictures.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// The curves that bring light within what a display can show.

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

// What a scene leaves to its picture: exposure and white.

FinishSettings open(ToneCurve curve) {
  FinishSettings finish;
  finish.tone = curve;
  finish.exposure.reset();
  finish.white.reset();
  return finish;
}

// Gray light over many powers of ten, in a part of the picture.
Image field_of_light(double filled, double octaves, double factor = 1) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  Image image(200, 200);
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    if (unit(random) >= filled) continue;
    const auto light = static_cast<float>(factor * std::exp2(octaves * unit(random)));
    std::fill_n(&image.pixels[i], 3, light);
  }
  return image;
}

LightHistogram histogram(const Image& image) {
  LightHistogram light;
  light.add(image);
  return light;
}

FinishSettings levels(const FinishSettings& finish, const Image& image) {
  return with_any_tone(finish, 1, histogram(image));
}

// The part of all pixels whose brightest channel is at least this after finishing.
double part_from(double least, Image image, const FinishSettings& finish) {
  adjust_light(image, finish, 1);
  std::size_t count = 0;
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    if (std::max({image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]}) >= least) ++count;
  }
  return 4 * static_cast<double>(count) / static_cast<double>(image.pixels.size());
}

TEST(ToneLevels, StayWhereTheSceneGivesThem) {
  FinishSettings finish;
  finish.exposure = -2;
  finish.white = 3;
  const FinishSettings found = levels(finish, field_of_light(1, 10));
  EXPECT_EQ(found.exposure, -2);
  EXPECT_EQ(found.white, 3);
}

TEST(ToneLevels, LetHardlyAnythingBeWhite) {
  for (const ToneCurve curve : {ToneCurve::linear, ToneCurve::asinh, ToneCurve::filmic}) {
    for (const double octaves : {0.0, 3.0, 12.0, 24.0}) {
      const Image image = field_of_light(0.7, octaves, 1e-3);
      EXPECT_LE(part_from(0.996, image, levels(open(curve), image)), 0.005) << octaves;
    }
  }
}

TEST(ToneLevels, ShowAQuarterOfThePicture) {
  for (const ToneCurve curve : {ToneCurve::asinh, ToneCurve::filmic}) {
    for (const double octaves : {0.0, 3.0, 12.0, 24.0}) {
      const Image image = field_of_light(0.7, octaves, 1e3);
      EXPECT_GE(part_from(0.02, image, levels(open(curve), image)), 0.25) << octaves;
    }
  }
}

TEST(ToneLevels, ShowAsMuchAsMatterFills) {
  const Image image = field_of_light(0.1, 8);
  EXPECT_GE(part_from(0.02, image, levels(open(ToneCurve::filmic), image)), 0.09);
}

TEST(ToneLevels, AreNotLedAstrayByAFewBrightStars) {
  Image image = field_of_light(0.9, 6);
  const FinishSettings without = levels(open(ToneCurve::asinh), image);
  for (std::size_t i = 0; i < 20; ++i)
    image.pixels[4000 * i] = 1e20F;
  const FinishSettings with = levels(open(ToneCurve::asinh), image);
  EXPECT_NEAR(*with.exposure, *without.exposure, 0.1);
  EXPECT_NEAR(*with.white / *without.white, 1, 0.05);
}

TEST(ToneLevels, FollowTheUnitOfLight) {
  const FinishSettings once = levels(open(ToneCurve::filmic), field_of_light(1, 10));
  const FinishSettings dimmer = levels(open(ToneCurve::filmic), field_of_light(1, 10, 1.0 / 1024));
  EXPECT_NEAR(*dimmer.exposure, *once.exposure + 10, 1e-9);
  EXPECT_EQ(dimmer.white, once.white);
}

TEST(ToneLevels, DoNotHangOnLastDigits) {
  const Image image = field_of_light(1, 10);
  Image other = image;
  for (float& value : other.pixels)
    value *= 1 + 1e-6F;
  const FinishSettings a = levels(open(ToneCurve::filmic), image);
  const FinishSettings b = levels(open(ToneCurve::filmic), other);
  EXPECT_EQ(a.exposure, b.exposure);
  EXPECT_EQ(a.white, b.white);
}

TEST(ToneLevels, ExposeForTheWhiteThatIsGiven) {
  FinishSettings finish = open(ToneCurve::asinh);
  finish.white = 4;
  const Image image = field_of_light(1, 10);
  const FinishSettings found = levels(finish, image);
  EXPECT_EQ(found.white, 4);
  EXPECT_LE(part_from(1, image, found), 0.003);
  EXPECT_GT(part_from(0.95, image, found), 0.003);
}

TEST(ToneLevels, FindNothingInABlackPicture) {
  const Image black(4, 4);
  EXPECT_FALSE(with_tone_of(open(ToneCurve::filmic), 1, histogram(black)));
  const FinishSettings any = levels(open(ToneCurve::filmic), black);
  EXPECT_EQ(any.exposure, 0);
  EXPECT_EQ(any.white, 1);
}

TEST(ToneLevels, OfOneAreTakenWhereAnotherLeavesThemOpen) {
  FinishSettings found;
  found.exposure = 3;
  found.white = 5;
  FinishSettings finish;
  finish.exposure = -1;
  finish.white.reset();
  take_tone(found, finish);
  EXPECT_EQ(finish.exposure, -1);
  EXPECT_EQ(finish.white, 5);
}

const std::array<float, 3> light = {0.7F, 0.2F, 3.5F};

Image adjusted(const FinishSettings& finish, double gamma = 1,
               const std::array<float, 3>& from = light) {
  Image image = plain_image(3, 2, from);
  for (std::size_t i = 3; i < image.pixels.size(); i += 4)
    image.pixels[i] = 0.375F;
  adjust_light(image, finish, gamma);
  return image;
}

TEST(AdjustLight, LeavesEveryBitWhereNothingIsAskedFor) {
  FinishSettings finish;
  finish.contrast_pivot = 0.3;
  EXPECT_EQ(adjusted(finish, 2.2).pixels, adjusted({}).pixels);
  EXPECT_EQ(adjusted(finish).at(2, 1)[2], 3.5F);
}

TEST(AdjustLight, DoublesWithOneStopOfExposure) {
  FinishSettings finish;
  finish.exposure = 1;
  for (int c = 0; c < 3; ++c)
    EXPECT_EQ(adjusted(finish).at(1, 1)[c], 2 * light[static_cast<std::size_t>(c)]);
}

TEST(AdjustLight, IsGrayOfItsLuminanceWithoutSaturation) {
  FinishSettings finish;
  finish.saturation = 0;
  const float luminance = 0.2126F * light[0] + 0.7152F * light[1] + 0.0722F * light[2];
  for (int c = 0; c < 3; ++c)
    EXPECT_FLOAT_EQ(adjusted(finish).at(0, 0)[c], luminance);
}

TEST(AdjustLight, KeepsGrayWithAnySaturation) {
  FinishSettings finish;
  finish.saturation = 2.5;
  for (int c = 0; c < 3; ++c)
    EXPECT_FLOAT_EQ(adjusted(finish, 1, {0.4F, 0.4F, 0.4F}).at(0, 0)[c], 0.4F);
}

TEST(AdjustLight, NeverGivesNegativeLightWithMuchSaturation) {
  FinishSettings finish;
  finish.saturation = 4;
  EXPECT_EQ(adjusted(finish).at(0, 0)[1], 0.0F);
}

TEST(AdjustLight, LeavesThePivotOfContrastAndDarkness) {
  FinishSettings finish;
  finish.contrast = 1.7;
  finish.contrast_pivot = 0.7;
  EXPECT_FLOAT_EQ(adjusted(finish).at(0, 0)[0], 0.7F);
  EXPECT_EQ(adjusted(finish, 1, {0, 0, 0}).at(0, 0)[0], 0.0F);
}

// v' = pivot (v / pivot)^contrast for what the display shows, v = L^(1/gamma).
TEST(AdjustLight, ChangesContrastOfDisplayValues) {
  FinishSettings finish;
  finish.contrast = 1.5;
  finish.contrast_pivot = 0.4;
  const double gamma = 2.2;
  const Image image = adjusted(finish, gamma);
  for (std::size_t c = 0; c < 3; ++c) {
    const double shown = std::pow(static_cast<double>(light[c]), 1 / gamma);
    EXPECT_NEAR(std::pow(static_cast<double>(image.at(0, 0)[c]), 1 / gamma),
                0.4 * std::pow(shown / 0.4, 1.5), 1e-5);
  }
}

TEST(AdjustLight, ExposesBeforeItChangesContrast) {
  FinishSettings finish;
  finish.exposure = 1;
  finish.contrast = 2;
  finish.contrast_pivot = 0.4;
  // 0.2 is exposed to the pivot, which contrast leaves.
  EXPECT_FLOAT_EQ(adjusted(finish, 1, {0.2F, 0.2F, 0.2F}).at(0, 0)[0], 0.4F);
}

TEST(AdjustLight, LeavesAlpha) {
  FinishSettings finish;
  finish.exposure = 2;
  finish.saturation = 0.5;
  finish.contrast = 2;
  EXPECT_EQ(adjusted(finish).at(1, 0)[3], 0.375F);
}

}  // namespace
}  // namespace splotchcl::test
